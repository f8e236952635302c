#include "service/storage/sqlite.h"

#include <cerrno>
#include <functional>
#include <map>
#include <utility>

#include <sqlite3.h>

#include "core/base/error.h"
#include "service/storage/dialect.h"
#include "service/storage/sqlite_error.h"

namespace gaitmill {

namespace {

constexpr int kBusyMilliseconds = 10'000;  // for another process, a worker for instance

bool meansFull(sqlite3* handle) {
  constexpr int kPrimary = 0xff;
  const int code = sqlite3_errcode(handle) & kPrimary;
  if (code == SQLITE_FULL) {
    return true;
  }
  const int system = sqlite3_system_errno(handle);
  return (code == SQLITE_IOERR || code == SQLITE_CANTOPEN) &&
         (system == ENOSPC || system == EDQUOT);
}

class SqliteStatement final : public PreparedStatement {
 public:
  SqliteStatement(sqlite3* handle, sqlite3_stmt* statement)
      : handle_(handle), statement_(statement) {}
  ~SqliteStatement() override { sqlite3_finalize(statement_); }
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  void bindNull(int parameter) override { requireOk(sqlite3_bind_null(statement_, parameter)); }
  void bindInteger(int parameter, std::int64_t value) override {
    requireOk(sqlite3_bind_int64(statement_, parameter, value));
  }
  void bindReal(int parameter, double value) override {
    requireOk(sqlite3_bind_double(statement_, parameter, value));
  }
  void bindText(int parameter, std::string_view text) override {
    const char* data = text.data() == nullptr ? "" : text.data();
    requireOk(sqlite3_bind_text64(
        statement_, parameter, data, text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  }
  void bindBytes(int parameter, std::string_view bytes) override {
    const char* data = bytes.data() == nullptr ? "" : bytes.data();
    requireOk(sqlite3_bind_blob64(statement_, parameter, data, bytes.size(), SQLITE_STATIC));
  }
  bool step() override {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) {
      throwSqliteError(handle_, sqlite3_sql(statement_));
    }
    return result == SQLITE_ROW;
  }
  void reset() noexcept override {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
  }
  bool isNull(int column) const override {
    return sqlite3_column_type(statement_, column) == SQLITE_NULL;
  }
  std::int64_t integer(int column) const override {
    return sqlite3_column_int64(statement_, column);
  }
  double real(int column) const override { return sqlite3_column_double(statement_, column); }
  std::string_view bytes(int column) const override {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return data == nullptr ? std::string_view() : std::string_view(data, size);
  }

 private:
  void requireOk(int result) {
    if (result != SQLITE_OK) {
      throwSqliteError(handle_, "binding a parameter");
    }
  }

  sqlite3* handle_;
  sqlite3_stmt* statement_;
};

class SqliteConnection final : public Connection {
 public:
  explicit SqliteConnection(const SqliteOptions& options);
  ~SqliteConnection() override {
    prepared_.clear();
    sqlite3_close(handle_);
  }
  SqliteConnection(const SqliteConnection&) = delete;
  SqliteConnection& operator=(const SqliteConnection&) = delete;

  Statement prepare(std::string_view sql) override;
  void runScript(const char* sql) override;
  std::int64_t changes() const override { return sqlite3_changes64(handle_); }
  bool isInTransaction() const override { return sqlite3_get_autocommit(handle_) == 0; }

 private:
  void configure(const SqliteOptions& options);

  sqlite3* handle_ = nullptr;
  std::map<std::string, std::unique_ptr<SqliteStatement>, std::less<>> prepared_;
};

SqliteConnection::SqliteConnection(const SqliteOptions& options) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  const char* vfs = options.vfs.empty() ? nullptr : options.vfs.c_str();
  try {
    if (sqlite3_open_v2(options.path.c_str(), &handle_, flags, vfs) != SQLITE_OK) {
      throwSqliteError(handle_, "opening the database");
    }
    configure(options);
  } catch (Error& error) {
    sqlite3_close(handle_);
    error.setFile(options.path);
    throw;
  }
}

void SqliteConnection::configure(const SqliteOptions& options) {
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, kBusyMilliseconds);
  runScript(dialect::kConnectionSettings);
  if (options.max_size > 0) {
    Statement page_size = prepare("PRAGMA page_size");
    page_size.step();
    const std::int64_t pages = options.max_size / page_size.integer(0);
    runScript(("PRAGMA max_page_count = " + std::to_string(pages)).c_str());
  }
}

Statement SqliteConnection::prepare(std::string_view sql) {
  auto found = prepared_.find(sql);
  if (found == prepared_.end()) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v3(handle_,
                           sql.data(),
                           static_cast<int>(sql.size()),
                           SQLITE_PREPARE_PERSISTENT,
                           &statement,
                           nullptr) != SQLITE_OK) {
      throwSqliteError(handle_, std::string(sql));
    }
    found = prepared_.emplace(sql, std::make_unique<SqliteStatement>(handle_, statement)).first;
  }
  return Statement(*found->second);
}

void SqliteConnection::runScript(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    throwSqliteError(handle_, "running a script");
  }
}

}  // namespace

void throwSqliteError(sqlite3* handle, const std::string& step) {
  throw Error(meansFull(handle) ? ErrorCode::kStorageFull : ErrorCode::kStorage,
              step + ": " + sqlite3_errmsg(handle));
}

std::unique_ptr<Connection> openSqlite(const SqliteOptions& options) {
  return std::make_unique<SqliteConnection>(options);
}

}  // namespace gaitmill
