#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace gaitmill {

/// What a database's own client does for one statement. Parameters count from 1, columns from 0.
class PreparedStatement {
 public:
  virtual ~PreparedStatement() = default;
  virtual void bindNull(int parameter) = 0;
  virtual void bindInteger(int parameter, std::int64_t value) = 0;
  virtual void bindReal(int parameter, double value) = 0;
  virtual void bindText(int parameter, std::string_view text) = 0;
  /// The bytes live until the statement has run.
  virtual void bindBytes(int parameter, std::string_view bytes) = 0;
  /// Next row; false at the end. @throws Error kStorage, kStorageFull
  virtual bool step() = 0;
  /// Ends the execution and forgets the parameters.
  virtual void reset() noexcept = 0;
  virtual bool isNull(int column) const = 0;
  virtual std::int64_t integer(int column) const = 0;
  virtual double real(int column) const = 0;
  /// Of a text or of bytes, until the next step.
  virtual std::string_view bytes(int column) const = 0;
};

/// One execution of a prepared statement. Ends it when it goes, so that no read outlives its use.
class Statement {
 public:
  explicit Statement(PreparedStatement& prepared) : prepared_(&prepared) {}
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  Statement& operator=(Statement&&) = delete;

  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, const std::string& text);
  Statement& bind(int parameter, const char* text);
  Statement& bind(int parameter, const std::optional<std::string>& text);
  Statement& bind(int parameter, const std::optional<std::int64_t>& value);
  /// The bytes must live until the statement has run.
  Statement& bindBytes(int parameter, std::string_view bytes);

  /// Next row; false at the end. @throws Error kStorage, kStorageFull
  bool step() { return prepared_->step(); }
  /// For statements whose rows nobody reads. @throws Error kStorage, kStorageFull
  void run();

  std::int64_t integer(int column) const { return prepared_->integer(column); }
  double real(int column) const { return prepared_->real(column); }
  std::string text(int column) const { return std::string(prepared_->bytes(column)); }
  std::string bytes(int column) const { return std::string(prepared_->bytes(column)); }
  bool isNull(int column) const { return prepared_->isNull(column); }
  std::optional<std::int64_t> optionalInteger(int column) const;
  std::optional<std::string> optionalText(int column) const;

 private:
  PreparedStatement* prepared_;
};

/// One connection to the database, used by one thread at a time. The stores see this and nothing
/// of the database behind it; dialect.h names what differs between databases.
class Connection {
 public:
  virtual ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Prepared once per connection and text. @throws Error kStorage
  virtual Statement prepare(std::string_view sql) = 0;
  /// Several statements at once, not kept: for migrations.
  virtual void runScript(const char* sql) = 0;
  /// Rows that the last statement changed.
  virtual std::int64_t changes() const = 0;
  /// Whether a transaction is open: some failures end it without being asked.
  virtual bool isInTransaction() const = 0;

 protected:
  Connection() = default;
};

}  // namespace gaitmill
