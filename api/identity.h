#pragma once

#include <string>

namespace gaitmill::api {

/// Who asks, and what it may do. Every port takes it, so that no look-up can forget the tenant.
struct Identity {
  std::string tenant = "local";  ///< owner of everything the caller creates and sees
  std::string key_id;            ///< "key_…"; empty for a local caller of a service without keys
  bool may_read = true;
  bool may_write = true;
  bool may_administer = true;
};

enum class Scope { kNone, kRead, kWrite, kAdmin };

}  // namespace gaitmill::api
