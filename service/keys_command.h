#pragma once

#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace gaitmill {

/// `gaitmill keys create`
struct CreateKeyOptions {
  std::string tenant = "local";  ///< whose trials and jobs the key sees
  std::string name;              ///< for people: "lab computer"
  std::vector<std::string> scopes = {"read", "write"};
};

/// `gaitmill keys list`
struct ListKeysOptions {
  std::string tenant;  ///< empty = all
};

/// `gaitmill keys revoke ID`
struct RevokeKeyOptions {
  std::string key_id;
};

/// `gaitmill keys`: on the database itself, beside a running service or without it. A running
/// service hears of changes within a second.
struct KeysOptions {
  std::string database = "gaitmill.db";
  std::variant<CreateKeyOptions, ListKeysOptions, RevokeKeyOptions> action;
};

/// A new key's token stands alone on the last line. @throws Error kKeyNotFound, kRequestField,
/// kStorage…
void manageKeys(const KeysOptions& options, std::ostream& out);

}  // namespace gaitmill
