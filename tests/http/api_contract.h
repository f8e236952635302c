#pragma once

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/http/http_client.h"

namespace gaitmill {

/// api/openapi.yaml as the tests hold it against the service. Tests run in the repository's top.
class ApiContract {
 public:
  ApiContract();

  /// Method, path and status of every documented answer.
  using Answer = std::tuple<std::string, std::string, int>;
  std::set<Answer> listAnswers() const;

  /// What is wrong with a reply of this route: a status or media type that is not documented, a
  /// body that does not fit its schema, a documented header that is missing.
  std::vector<std::string> findFaults(const std::string& method,
                                      const std::string& path,
                                      const ClientReply& reply) const;
  const nlohmann::json& document() const { return document_; }

 private:
  const nlohmann::json& resolve(const nlohmann::json& object) const;

  nlohmann::json document_;
};

}  // namespace gaitmill
