#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace gaitmill {

/// One execution of a prepared statement. Parameters count from 1, columns from 0. Resets the
/// statement when it goes, so that no read outlives its use.
class Statement {
 public:
  explicit Statement(sqlite3_stmt* prepared) : prepared_(prepared) {}
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  Statement& operator=(Statement&&) = delete;

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, const std::string& text);
  Statement& bind(int parameter, const std::optional<std::string>& text);
  /// The bytes must live until the statement has run.
  Statement& bindBytes(int parameter, const std::string& bytes);

  /// Next row; false at the end. @throws Error kStorage
  bool step();
  /// For statements without rows. @throws Error kStorage
  void run();

  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::string bytes(int column) const;
  bool isNull(int column) const;
  std::optional<std::int64_t> optionalInteger(int column) const;
  std::optional<std::string> optionalText(int column) const;

 private:
  sqlite3_stmt* prepared_;
};

/// One connection, for one thread. Statements are prepared once per connection.
class Connection {
 public:
  /// Opens or creates the file in WAL mode with full synchronisation and foreign keys.
  /// @throws Error kStorage
  explicit Connection(const std::string& path);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// @param sql  a constant that lives as long as the program: its address is its name
  Statement prepare(const char* sql);
  /// Several statements at once, not cached: for migrations.
  void runScript(const char* sql);
  /// Rows that the last statement changed.
  int changes() const;

 private:
  sqlite3* handle_ = nullptr;
  std::map<const char*, sqlite3_stmt*> prepared_;
};

/// A write transaction. Takes its turn among the threads of the process first, so that writers
/// queue fairly instead of sleeping and retrying in SQLite. Rolls back unless committed.
class Transaction {
 public:
  Transaction(Connection& connection, std::mutex& writers);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  /// Durable when it returns. @throws Error kStorage
  void commit();

 private:
  std::unique_lock<std::mutex> turn_;
  Connection& connection_;
  bool open_ = true;
};

}  // namespace gaitmill
