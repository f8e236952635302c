#include "service/storage/list_query.h"

#include <utility>

#include "core/base/error.h"
#include "service/storage/ids.h"

namespace gaitmill {

ListQuery::ListQuery(const char* select, const std::string& tenant, std::string prefix)
    : sql_(std::string(select) + " WHERE tenant = ?1"),
      prefix_(std::move(prefix)),
      values_({tenant}) {}

void ListQuery::add(const std::string& condition, const std::string& value) {
  values_.push_back(value);
  sql_ += " AND " + condition + " ?" + std::to_string(values_.size());
}

ListQuery& ListQuery::where(const char* condition, const std::string& value) {
  if (!value.empty()) {
    add(condition, value);
  }
  return *this;
}

ListQuery& ListQuery::whereNonEmpty(const char* column, const std::string& value) {
  if (!value.empty()) {
    sql_ += std::string(" AND ") + column + " <> ''";
    add(std::string(column) + " =", value);
  }
  return *this;
}

ListQuery& ListQuery::between(const std::optional<std::int64_t>& after,
                              const std::optional<std::int64_t>& before) {
  if (after) {
    add("id >=", makeIdBound(prefix_, *after + 1));
  }
  if (before) {
    add("id <", makeIdBound(prefix_, *before));
  }
  return *this;
}

ListQuery& ListQuery::page(const api::PageRequest& page) {
  if (!page.cursor.empty()) {
    require(isId(page.cursor, prefix_),
            ErrorCode::kRequestField,
            "'" + page.cursor + "' is no cursor of this list",
            {"", 0, 0, "cursor"});
    add("id <", page.cursor);
  }
  limit_ = page.limit + 1;
  sql_ += " ORDER BY id DESC LIMIT ?" + std::to_string(values_.size() + 1);
  return *this;
}

Statement ListQuery::run(Connection& db) const {
  Statement rows = db.prepare(sql_);
  int parameter = 0;
  for (const std::string& value : values_) {
    rows.bind(++parameter, value);
  }
  rows.bind(++parameter, limit_);
  return rows;
}

}  // namespace gaitmill
