#include "service/storage/sqlite.h"

#include <utility>

#include <sqlite3.h>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr int kBusyMilliseconds = 10'000;  // for another process, a backup for instance

constexpr const char* kPragmas =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;"
    "PRAGMA temp_store = MEMORY; PRAGMA trusted_schema = OFF";

[[noreturn]] void fail(sqlite3* handle, const std::string& step) {
  throw Error(ErrorCode::kStorage, step + ": " + sqlite3_errmsg(handle));
}

void requireOk(int result, sqlite3_stmt* statement, const char* step) {
  if (result != SQLITE_OK) {
    fail(sqlite3_db_handle(statement), step);
  }
}

}  // namespace

Statement::~Statement() {
  if (prepared_ != nullptr) {
    sqlite3_reset(prepared_);
    sqlite3_clear_bindings(prepared_);
  }
}

Statement::Statement(Statement&& other) noexcept
    : prepared_(std::exchange(other.prepared_, nullptr)) {}

Statement& Statement::bind(int parameter, std::int64_t value) {
  requireOk(sqlite3_bind_int64(prepared_, parameter, value), prepared_, "binding an integer");
  return *this;
}

Statement& Statement::bind(int parameter, double value) {
  requireOk(sqlite3_bind_double(prepared_, parameter, value), prepared_, "binding a number");
  return *this;
}

Statement& Statement::bind(int parameter, const std::string& text) {
  requireOk(sqlite3_bind_text64(
                prepared_, parameter, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8),
            prepared_,
            "binding a text");
  return *this;
}

Statement& Statement::bind(int parameter, const std::optional<std::string>& text) {
  if (text) {
    return bind(parameter, *text);
  }
  requireOk(sqlite3_bind_null(prepared_, parameter), prepared_, "binding nothing");
  return *this;
}

Statement& Statement::bindBytes(int parameter, const std::string& bytes) {
  requireOk(sqlite3_bind_blob64(prepared_, parameter, bytes.data(), bytes.size(), SQLITE_STATIC),
            prepared_,
            "binding bytes");
  return *this;
}

bool Statement::step() {
  const int result = sqlite3_step(prepared_);
  if (result != SQLITE_ROW && result != SQLITE_DONE) {
    fail(sqlite3_db_handle(prepared_), sqlite3_sql(prepared_));
  }
  return result == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(prepared_, column);
}

double Statement::real(int column) const {
  return sqlite3_column_double(prepared_, column);
}

std::string Statement::text(int column) const {
  return bytes(column);
}

std::string Statement::bytes(int column) const {
  const auto* data = static_cast<const char*>(sqlite3_column_blob(prepared_, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(prepared_, column));
  return data == nullptr ? std::string() : std::string(data, size);
}

bool Statement::isNull(int column) const {
  return sqlite3_column_type(prepared_, column) == SQLITE_NULL;
}

std::optional<std::int64_t> Statement::optionalInteger(int column) const {
  return isNull(column) ? std::nullopt : std::optional(integer(column));
}

std::optional<std::string> Statement::optionalText(int column) const {
  return isNull(column) ? std::nullopt : std::optional(text(column));
}

Connection::Connection(const std::string& path) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  if (sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string reason = sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw Error(ErrorCode::kStorage, "opening the database: " + reason, {path, 0, 0, ""});
  }
  sqlite3_busy_timeout(handle_, kBusyMilliseconds);
  try {
    runScript(kPragmas);
  } catch (Error& error) {
    sqlite3_close(handle_);
    error.setFile(path);
    throw;
  }
}

Connection::~Connection() {
  for (const auto& [sql, statement] : prepared_) {
    sqlite3_finalize(statement);
  }
  sqlite3_close(handle_);
}

Statement Connection::prepare(const char* sql) {
  sqlite3_stmt*& statement = prepared_[sql];
  if (statement == nullptr &&
      sqlite3_prepare_v3(handle_, sql, -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr) !=
          SQLITE_OK) {
    fail(handle_, sql);
  }
  return Statement(statement);
}

void Connection::runScript(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    fail(handle_, "running a script");
  }
}

int Connection::changes() const {
  return sqlite3_changes(handle_);
}

Transaction::Transaction(Connection& connection, std::mutex& writers)
    : turn_(writers), connection_(connection) {
  connection_.prepare("BEGIN IMMEDIATE").run();
}

Transaction::~Transaction() {
  if (open_) {
    try {
      connection_.prepare("ROLLBACK").run();
    } catch (const Error&) {
      // SQLite rolls back by itself after some errors; there is then nothing left to undo.
    }
  }
}

void Transaction::commit() {
  connection_.prepare("COMMIT").run();
  open_ = false;
}

}  // namespace gaitmill
