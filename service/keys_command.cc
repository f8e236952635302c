#include "service/keys_command.h"

#include "api/dto/timestamp.h"
#include "service/key_service.h"
#include "service/storage/database.h"

namespace gaitmill {

namespace {

std::string joinScopes(const api::KeyView& key) {
  std::string list;
  for (const std::string& scope : key.scopes) {
    list += (list.empty() ? "" : ",") + scope;
  }
  return list;
}

void printKey(const api::KeyView& key, std::ostream& out) {
  out << key.id << "  " << api::formatTimestamp(key.created_at) << "  " << key.tenant << "  "
      << joinScopes(key) << "  "
      << (key.revoked_at == 0 ? "in force" : "revoked " + api::formatTimestamp(key.revoked_at))
      << "  " << key.name << '\n';
}

void perform(KeyStore& store, const CreateKeyOptions& options, std::ostream& out) {
  api::Identity administrator;
  administrator.tenant = options.tenant;
  const api::KeyView key =
      KeyService(store, nullptr).add(administrator, options.name, options.scopes);
  printKey(key, out);
  out << "The token below is not kept anywhere: note it now.\n" << key.secret << '\n';
}

void perform(KeyStore& store, const ListKeysOptions& options, std::ostream& out) {
  for (const api::KeyView& key : store.list(options.tenant)) {
    printKey(key, out);
  }
}

void perform(KeyStore& store, const RevokeKeyOptions& options, std::ostream& out) {
  store.revoke("", options.key_id);
  out << options.key_id << " is revoked\n";
}

}  // namespace

void manageKeys(const KeysOptions& options, std::ostream& out) {
  DatabaseOptions opened;
  opened.path = options.database;
  opened.use = DatabaseUse::kWork;
  Database database(opened);
  KeyStore store(database);
  std::visit([&](const auto& action) { perform(store, action, out); }, options.action);
}

}  // namespace gaitmill
