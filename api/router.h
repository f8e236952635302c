#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api/http.h"
#include "api/identity.h"

namespace gaitmill::api {

/// What a route takes as its body. Anything else is refused with 415 before the body is read.
enum class BodyKind {
  kNone,             ///< a short body is read and ignored
  kJson,             ///< application/json
  kMultipart,        ///< multipart/form-data
  kMultipartOrJson,  ///< either
  kBytes,            ///< any media type, taken as it is
};

/// One route: "/v1/jobs/{id}" with its method, the body it takes and what it does. The handler may
/// move parts out of the request and throws Error. A handler that parks its request is called again
/// with the same request object, and so finds what it noted there.
struct Route {
  std::string method;
  std::string pattern;
  BodyKind body = BodyKind::kNone;
  std::function<HttpReply(HttpRequest&)> handle;
  Scope scope = Scope::kNone;   ///< of the key, where the service has keys; kNone = open to all
  std::uint64_t max_bytes = 0;  ///< [bytes] of the body; 0 = the server's limit for its kind
  bool is_slow = false;         ///< takes its time: half of the threads stay free of such requests
};

struct RouteMatch {
  const Route* route = nullptr;  ///< nullptr if no route has this path and method
  std::map<std::string, std::string> captures;
  std::vector<std::string> methods;  ///< that the path has; empty if the path is unknown
};

/// Finds routes by comparing path segments: no regular expressions, so that no path can make the
/// search slow or deep. A capture takes one segment of 1 to 100 letters, digits, '_', '.' or '-'.
class Router {
 public:
  explicit Router(std::vector<Route> routes);

  RouteMatch find(const std::string& method, const std::string& path) const;
  const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace gaitmill::api
