#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/http.h"
#include "api/identity.h"
#include "api/router.h"

namespace gaitmill::api {

/// One answered request, for the access log and the metrics.
struct RequestRecord {
  std::string id;       ///< as in the answer's Request-Id
  std::string method;   ///< as sent; empty if the request could not be read
  std::string pattern;  ///< of the route, "/v1/jobs/{id}"; empty if there is none
  std::string path;     ///< decoded, at most max_target_bytes
  std::string client;   ///< address
  std::string tenant;
  std::string key_id;
  int status = 0;                   ///< 0 = the connection went before an answer
  double seconds = 0;               ///< [s] from the request's first byte to the answer's last
  std::uint64_t request_bytes = 0;  ///< [bytes] of the body
  std::uint64_t reply_bytes = 0;    ///< [bytes] sent, headers included
};

/// Who the Authorization header speaks for; nullopt if nobody. Called on the one thread that reads
/// all sockets: answers from memory or by one indexed look-up.
using Authenticator =
    std::function<std::optional<Identity>(const std::string& authorization_header)>;

/// Called once per request, on the thread that reads all sockets: must be quick.
using RequestHook = std::function<void(const RequestRecord& record)>;

/// Every limit of the transport. What a client can make the service hold is bounded by these:
/// connections times (headers + one piece), body_memory, and spool_bytes on disk.
struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 0;                  ///< 0 = any free port
  std::size_t threads = 16;      ///< for requests; solvers never run on them
  std::size_t max_queued = 512;  ///< requests waiting for a thread; more get 503
  std::size_t max_connections = 4096;
  std::size_t max_per_address = 256;  ///< connections of one client address
  bool count_loopback = false;        ///< whether max_per_address holds for loopback, where a proxy
                                      ///< speaks for all its clients
  std::size_t max_event_streams = 256;

  std::uint64_t max_json_bytes = 1U << 20U;      ///< [bytes] of a JSON body
  std::uint64_t max_upload_bytes = 256U << 20U;  ///< [bytes] of a multipart or raw body
  std::size_t max_parts = 16;                    ///< of a multipart body
  std::size_t max_target_bytes = 2048;           ///< [bytes] of path and query
  std::size_t max_header_bytes = 16U << 10U;     ///< [bytes] of request line and headers
  std::size_t max_headers = 64;

  std::string spool_folder = "/var/tmp";           ///< for bodies that memory shall not hold
  std::uint64_t spool_above = 256U << 10U;         ///< [bytes] a body that memory may hold
  std::uint64_t max_body_memory = 64U << 20U;      ///< [bytes] of all bodies in memory
  std::uint64_t max_spool_bytes = 4ULL << 30U;     ///< [bytes] of all spooled bodies
  std::uint64_t spool_free_bytes = 256ULL << 20U;  ///< [bytes] to leave free on the disk

  std::chrono::milliseconds keep_alive{60'000};       ///< idle time of a connection
  std::chrono::milliseconds header_deadline{10'000};  ///< from first byte to last header
  std::chrono::milliseconds body_deadline{20'000};    ///< within each such time a body must come to
                                                      ///< its end or move on at lowest_rate
  std::chrono::milliseconds reply_deadline{20'000};   ///< the same for the client taking a reply
  std::uint64_t lowest_rate = 16'384;                 ///< [bytes/s]
  std::chrono::milliseconds max_park{300'000};        ///< a long poll's limit is cut to this
  std::chrono::milliseconds stream_pulse{15'000};     ///< comment line on a silent event stream
  std::chrono::milliseconds ask_again{2'000};   ///< longest time a parked request or event stream
                                                ///< goes unasked: changes made by other processes
                                                ///< are not notified
  std::chrono::milliseconds stop_limit{5'000};  ///< for requests under way when stop() is called

  Authenticator authenticate;  ///< none = every caller is the local tenant with all rights
  RequestHook on_request;
};

enum class LogLevel { kDebug, kError };
/// Faults of our own (error) and what is refused (debug). Called from any thread of the server.
using ServerLog = std::function<void(LogLevel level, const std::string& line)>;

/// What the transport holds at this moment, for the metrics.
struct ServerLoad {
  std::size_t connections = 0;
  std::size_t event_streams = 0;
  std::size_t parked = 0;
  std::size_t queued = 0;  ///< requests waiting for a thread
};

class Reactor;

/// The routes behind a listening socket. What is refused (unknown path, length, encoding, media
/// type, key) is refused before the body is read; a connection with an unread body is then closed,
/// because the rest would pass for the next request.
class Server {
 public:
  Server(std::vector<Route> routes, ServerOptions options, ServerLog log);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Binds the address and raises the process's limit of open files to what the options need.
  /// @returns the port, the chosen one for 0
  /// @throws Error kServicePort if the address cannot be had
  int bind();
  /// Serves until stop() is called from another thread. Requires bind().
  void run();
  /// Returns at once; run() returns when the requests under way are answered, at the latest after
  /// stop_limit.
  void stop();
  /// Asks the long polls and event streams of this topic again. From any thread, cheap.
  void notify(const Topic& topic);
  ServerLoad load() const;

 private:
  std::unique_ptr<Reactor> reactor_;
};

}  // namespace gaitmill::api
