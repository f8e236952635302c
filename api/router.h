#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "api/http.h"

namespace gaitmill::api {

enum class BodyKind { kNone, kJson, kMultipart };

/// One route: "/v1/jobs/{id}" with its method, the body it takes and what it does. The handler may
/// move parts out of the request and throws Error.
struct Route {
  std::string method;
  std::string pattern;
  BodyKind body = BodyKind::kNone;
  std::function<HttpReply(HttpRequest&)> handle;
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
