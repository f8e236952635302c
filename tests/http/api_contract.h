#pragma once

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/http/http_client.h"

namespace gaitmill {

/// The served document as the tests hold it against the service.
class ApiContract {
 public:
  ApiContract();

  /// Method, path and status of every documented answer.
  using Answer = std::tuple<std::string, std::string, int>;
  std::set<Answer> listAnswers() const;

  /// Media types that the document has for an answer; none for one without a body.
  std::vector<std::string> listMediaTypes(const Answer& answer) const;

  /// What is wrong with a reply of this route: a status or media type that is not documented, a
  /// body that does not fit its schema, a documented header that is missing.
  std::vector<std::string> findFaults(const std::string& method,
                                      const std::string& path,
                                      const ClientReply& reply) const;
  const nlohmann::json& document() const { return document_; }

 private:
  const nlohmann::json& resolve(const nlohmann::json& object) const;
  const nlohmann::json& findResponse(const Answer& answer) const;
  std::vector<std::string> findBodyFaults(const nlohmann::json& response,
                                          const std::string& content_type,
                                          const std::string& body) const;

  nlohmann::json document_;
};

}  // namespace gaitmill
