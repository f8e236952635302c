#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace gaitmill {

struct RawReply {
  int status = 0;                              ///< 0 = the connection ended before a whole head
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;

  std::string header(const std::string& lower_case_name) const;
};

/// One connection on which a test sends any bytes it likes and reads replies one by one.
class RawClient {
 public:
  explicit RawClient(int port);
  ~RawClient();
  RawClient(RawClient&& other) noexcept;
  RawClient& operator=(RawClient&& other) noexcept;
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool isConnected() const { return socket_ >= 0; }
  /// Blocks until all is sent. @returns false if the server does not take it
  bool send(std::string_view bytes);
  /// The next reply with the body that its Content-Length promises.
  RawReply read();
  /// The next reply's head alone, as after HEAD or before an event stream.
  RawReply readHead();
  /// Whatever comes until `text` has come, the server closes, or nothing comes for ten seconds.
  std::string readUntil(std::string_view text);
  /// Whatever comes until the server closes.
  std::string readToEnd();
  /// Takes at most `size` bytes that have come or come soon.
  std::string readSome(std::size_t size);
  /// Whether the server closes within `limit`, sending nothing more.
  bool isClosedWithin(std::chrono::milliseconds limit);
  /// Tells the server that nothing more comes.
  void endSending();
  void close();

 private:
  bool fill(int limit_ms);

  int socket_ = -1;
  std::string buffer_;  ///< received and not yet read
};

/// "GET path" with the headers that every request needs.
std::string makeGet(const std::string& path, const std::string& headers = "");
/// A request with a body and its Content-Length.
std::string makeRequest(const std::string& method,
                        const std::string& path,
                        const std::string& content_type,
                        const std::string& body,
                        const std::string& headers = "");

}  // namespace gaitmill
