#include "core/base/error.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/base/progress.h"

namespace gaitmill {

std::string_view codeName(ErrorCode code) {
  switch (code) {
#define GAITMILL_ERROR(enumerator, name) \
  case ErrorCode::enumerator:            \
    return name;
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
  }
  return "internal";
}

const std::vector<ErrorCode>& allErrorCodes() {
  static const std::vector<ErrorCode> codes = {
#define GAITMILL_ERROR(enumerator, name) ErrorCode::enumerator,
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
  };
  return codes;
}

Error::Error(ErrorCode code, std::string message, Where where)
    : code_(code), message_(std::move(message)), where_(std::move(where)) {
  composeWhat();
}

Error& Error::addContext(std::string step) {
  context_.push_back(std::move(step));
  composeWhat();
  return *this;
}

Error& Error::setFile(const std::string& file) {
  if (where_.file.empty()) {
    where_.file = file;
    composeWhat();
  }
  return *this;
}

void Error::composeWhat() {
  what_.clear();
  if (!where_.file.empty()) {
    what_ += where_.file + ":";
  }
  if (where_.line > 0) {
    what_ += std::to_string(where_.line) + ":";
    if (where_.column > 0) {
      what_ += std::to_string(where_.column) + ":";
    }
  }
  if (!what_.empty()) {
    what_ += " ";
  }
  if (!where_.field.empty()) {
    what_ += where_.field + ": ";
  }
  what_ += message_;
  what_ += " [" + std::string(codeName(code_)) + "]";
  for (const std::string& step : context_) {
    what_ += " (" + step + ")";
  }
}

void require(bool ok, ErrorCode code, const std::string& message, const Where& where) {
  if (!ok) {
    throw Error(code, message, where);
  }
}

void reportProgress(const Progress& progress, double fraction) {
  if (progress && !progress(fraction)) {
    throw Error(ErrorCode::kCancelled, "the computation was asked to stop");
  }
}

void check(bool ok, const char* message) {
  if (!ok) {
    throw Error(ErrorCode::kInternal, message);
  }
}

namespace {

std::size_t calcEditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string findNearestName(std::string_view name, const std::vector<std::string>& names) {
  // More than a third of the letters wrong is another word, not a misspelling.
  std::size_t best = name.size() / 3 + 2;
  std::string nearest;
  for (const std::string& candidate : names) {
    const std::size_t distance = calcEditDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace gaitmill
