#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/page.h"
#include "service/storage/connection.h"

namespace gaitmill {

/// A page of a tenant's rows, newest first. Ids sort by time, so order, cursor and time range are
/// all ranges of ids, and an index whose last column is the id serves each list.
class ListQuery {
 public:
  /// @param select  "SELECT … FROM …", the id in its first column
  /// @param prefix  of the ids
  ListQuery(const char* select, const std::string& tenant, std::string prefix);

  /// @param condition  up to the value: "state ="; nothing if the value is empty
  ListQuery& where(const char* condition, const std::string& value);
  /// By a column that has a partial index on its non-empty values.
  ListQuery& whereNonEmpty(const char* column, const std::string& value);
  ListQuery& between(const std::optional<std::int64_t>& after,
                     const std::optional<std::int64_t>& before);
  /// @throws Error kRequestField for a cursor that is none of these ids
  ListQuery& page(const api::PageRequest& page);

  const std::string& sql() const { return sql_; }
  /// Rows of the page, and one more if there is a next page.
  Statement run(Connection& db) const;

 private:
  void add(const std::string& condition, const std::string& value);

  std::string sql_;
  std::string prefix_;
  std::vector<std::string> values_;
  std::int64_t limit_ = 0;
};

/// Cuts off the row beyond the page and sets the cursor.
template <class View>
api::Page<View> makePage(std::vector<View> rows, const api::PageRequest& request) {
  api::Page<View> page;
  const auto limit = static_cast<std::size_t>(request.limit);
  if (rows.size() > limit) {
    rows.resize(limit);
    page.next_cursor = rows.back().id;
  }
  page.items = std::move(rows);
  return page;
}

}  // namespace gaitmill
