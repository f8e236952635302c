#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace gaitmill {

struct ClientReply {
  int status = 0;  ///< 0 = the connection failed
  std::map<std::string, std::string> headers;
  std::string body;

  nlohmann::json json() const;
};

struct ClientPart {
  std::string name;
  std::string file_name;
  std::string bytes;
};

/// A client over a real socket.
class HttpClient {
 public:
  explicit HttpClient(int port) : port_(port) {}

  ClientReply get(const std::string& path,
                  const std::map<std::string, std::string>& headers = {}) const;
  ClientReply post(const std::string& path,
                   const std::string& body,
                   const std::string& content_type = "application/json") const;
  ClientReply upload(const std::string& path, const std::vector<ClientPart>& parts) const;

  /// Sends the bytes as they are and returns what comes back until the server closes, is silent for
  /// three seconds, or has sent `last`.
  std::string sendRaw(const std::string& bytes, const std::string& last = "") const;

  /// Asks for the job every few milliseconds until it is in one of these states.
  /// @throws std::runtime_error after five minutes, which even a sanitizer does not need
  nlohmann::json waitForState(const std::string& job_id,
                              const std::vector<std::string>& states) const;

 private:
  int port_;
};

}  // namespace gaitmill
