#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "api/router.h"

namespace gaitmill::api {

struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 0;                                ///< 0 = any free port
  std::size_t threads = 32;                    ///< for requests; solvers never run on them
  std::size_t max_json_bytes = 1U << 20U;      ///< [bytes] of a JSON body
  std::size_t max_upload_bytes = 256U << 20U;  ///< [bytes] of a multipart body, all parts
  std::size_t max_parts = 16;                  ///< of a multipart body
  std::size_t max_target_bytes = 1024;         ///< [bytes] of path and query
  std::size_t max_header_bytes = 16U << 10U;   ///< [bytes] of request line and headers
  std::size_t max_headers = 64;
  std::chrono::seconds keep_alive{5};        ///< idle time after which a connection is closed
  std::chrono::seconds header_deadline{10};  ///< from a request's first byte to its last header
  std::chrono::seconds body_deadline{30};    ///< for the body, plus its time at the lowest rate
  std::size_t lowest_rate = 100'000;         ///< [bytes/s] at which a body may come
};

enum class LogLevel { kDebug, kError };
/// One line per request (debug) or fault of our own (error). Called from request threads.
using ServerLog = std::function<void(LogLevel level, const std::string& line)>;

/// The routes behind a listening socket. What is refused (unknown path, length, encoding, media
/// type) is refused before the body is read; a connection with an unread body is then closed,
/// because the rest would pass for the next request.
class Server {
 public:
  Server(std::vector<Route> routes, ServerOptions options, ServerLog log);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Binds the address. @returns the port, the chosen one for 0
  /// @throws Error kServicePort if the address cannot be had
  int bind();
  /// Serves until stop() is called from another thread. Requires bind().
  void run();
  void stop();

 private:
  class Transport;
  std::unique_ptr<Transport> transport_;
};

}  // namespace gaitmill::api
