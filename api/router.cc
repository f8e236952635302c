#include "api/router.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace gaitmill::api {

namespace {

using Captures = std::map<std::string, std::string>;

constexpr std::size_t kMaxCapture = 100;

bool isCapturable(std::string_view segment) {
  return !segment.empty() && segment.size() <= kMaxCapture && segment.front() != '.' &&
         std::all_of(segment.begin(), segment.end(), [](char letter) {
           return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
                  letter == '.' || letter == '-';
         });
}

// Takes the text up to the next '/' off the front of `rest`.
std::string_view takeSegment(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('/'), rest.size());
  const std::string_view segment = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return segment;
}

std::optional<Captures> match(std::string_view pattern, std::string_view path) {
  if (std::count(pattern.begin(), pattern.end(), '/') !=
      std::count(path.begin(), path.end(), '/')) {
    return std::nullopt;
  }
  Captures captures;
  while (!pattern.empty() || !path.empty()) {
    const std::string_view expected = takeSegment(pattern);
    const std::string_view found = takeSegment(path);
    if (!expected.empty() && expected.front() == '{') {
      if (!isCapturable(found)) {
        return std::nullopt;
      }
      captures.emplace(expected.substr(1, expected.size() - 2), found);
    } else if (expected != found) {
      return std::nullopt;
    }
  }
  return captures;
}

}  // namespace

Router::Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

RouteMatch Router::find(const std::string& method, const std::string& path) const {
  RouteMatch result;
  for (const Route& route : routes_) {
    const std::optional<Captures> captures = match(route.pattern, path);
    if (!captures) {
      continue;
    }
    result.methods.push_back(route.method);
    if (route.method == method) {
      result.route = &route;
      result.captures = *captures;
    }
  }
  return result;
}

}  // namespace gaitmill::api
