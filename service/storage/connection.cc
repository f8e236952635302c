#include "service/storage/connection.h"

#include <utility>

namespace gaitmill {

Statement::~Statement() {
  if (prepared_ != nullptr) {
    prepared_->reset();
  }
}

Statement::Statement(Statement&& other) noexcept
    : prepared_(std::exchange(other.prepared_, nullptr)) {}

Statement& Statement::bind(int parameter, std::int64_t value) {
  prepared_->bindInteger(parameter, value);
  return *this;
}

Statement& Statement::bind(int parameter, double value) {
  prepared_->bindReal(parameter, value);
  return *this;
}

Statement& Statement::bind(int parameter, const std::string& text) {
  prepared_->bindText(parameter, text);
  return *this;
}

Statement& Statement::bind(int parameter, const char* text) {
  prepared_->bindText(parameter, text);
  return *this;
}

Statement& Statement::bind(int parameter, const std::optional<std::string>& text) {
  if (text) {
    prepared_->bindText(parameter, *text);
  } else {
    prepared_->bindNull(parameter);
  }
  return *this;
}

Statement& Statement::bind(int parameter, const std::optional<std::int64_t>& value) {
  if (value) {
    prepared_->bindInteger(parameter, *value);
  } else {
    prepared_->bindNull(parameter);
  }
  return *this;
}

Statement& Statement::bindBytes(int parameter, std::string_view bytes) {
  prepared_->bindBytes(parameter, bytes);
  return *this;
}

void Statement::run() {
  while (prepared_->step()) {
  }
}

std::optional<std::int64_t> Statement::optionalInteger(int column) const {
  return isNull(column) ? std::nullopt : std::optional(integer(column));
}

std::optional<std::string> Statement::optionalText(int column) const {
  return isNull(column) ? std::nullopt : std::optional(text(column));
}

}  // namespace gaitmill
