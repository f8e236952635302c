#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/progress.h"
#include "core/base/text.h"

namespace gaitmill {

std::string_view codeName(ErrorCode code) {
  switch (code) {
#define GAITMILL_ERROR(enumerator, name, fix) \
  case ErrorCode::enumerator:                 \
    return name;
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
  }
  return "internal";
}

std::string_view codeFix(ErrorCode code) {
  switch (code) {
#define GAITMILL_ERROR(enumerator, name, fix) \
  case ErrorCode::enumerator:                 \
    return fix;
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
  }
  return "";
}

const std::vector<ErrorCode>& allErrorCodes() {
  static const std::vector<ErrorCode> codes = {
#define GAITMILL_ERROR(enumerator, name, fix) ErrorCode::enumerator,
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
  };
  return codes;
}

namespace {

/// Cut to Error::kMaximumText bytes, between two characters.
std::string shorten(std::string text) {
  constexpr std::string_view kCut = "...";
  if (text.size() <= Error::kMaximumText) {
    return text;
  }
  std::size_t end = Error::kMaximumText - kCut.size();
  const auto continues = [&](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // inside a UTF-8 sequence
  };
  while (end > 0 && continues(text[end])) {
    --end;
  }
  text.resize(end);
  return text.append(kCut);
}

Where shorten(Where where) {
  for (std::string* text :
       {&where.file, &where.field, &where.marker, &where.muscle, &where.coordinate}) {
    *text = shorten(std::move(*text));
  }
  return where;
}

}  // namespace

Error::Error(ErrorCode code, std::string message, Where where)
    : code_(code), message_(shorten(std::move(message))), where_(shorten(std::move(where))) {
  composeWhat();
}

Error& Error::addContext(std::string step) {
  context_.push_back(shorten(std::move(step)));
  composeWhat();
  return *this;
}

Error& Error::setFile(const std::string& file) {
  Where known;
  known.file = file;
  return completeWhere(known);
}

Error& Error::completeWhere(const Where& known) {
  where_.complete(shorten(known));
  composeWhat();
  return *this;
}

bool Where::isEmpty() const {
  return file.empty() && line == 0 && column == 0 && field.empty() && stage.empty() &&
         std::isnan(time) && marker.empty() && muscle.empty() && coordinate.empty();
}

void Where::complete(const Where& other) {
  const auto take = [](std::string& mine, const std::string& theirs) {
    mine = mine.empty() ? theirs : mine;
  };
  take(file, other.file);
  line = line > 0 ? line : other.line;
  column = column > 0 ? column : other.column;
  take(field, other.field);
  take(stage, other.stage);
  time = std::isnan(time) ? other.time : time;
  take(marker, other.marker);
  take(muscle, other.muscle);
  take(coordinate, other.coordinate);
}

namespace {

/// "walk1.trc:214:1: subject.mass_kg: "
std::string describeDocument(const Where& where) {
  std::string text;
  if (!where.file.empty()) {
    text += where.file + ":";
  }
  if (where.line > 0) {
    text += std::to_string(where.line) + ":";
    if (where.column > 0) {
      text += std::to_string(where.column) + ":";
    }
  }
  if (!text.empty()) {
    text += " ";
  }
  if (!where.field.empty()) {
    text += where.field + ": ";
  }
  return text;
}

/// "stage ik, 0.350 s, marker RASI"
std::string describeComputation(const Where& where) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += (text.empty() ? "" : ", ") + part;
  };
  const auto addNamed = [&](const char* kind, const std::string& name) {
    if (!name.empty()) {
      add(kind + name);
    }
  };
  addNamed("stage ", where.stage);
  if (!std::isnan(where.time)) {
    add(formatFixed(where.time, 3) + " s");
  }
  addNamed("marker ", where.marker);
  addNamed("muscle ", where.muscle);
  addNamed("coordinate ", where.coordinate);
  return text;
}

}  // namespace

void Error::composeWhat() {
  what_ = describeDocument(where_) + message_ + " [" + std::string(codeName(code_)) + "]";
  const std::string computation = describeComputation(where_);
  if (!computation.empty()) {
    what_ += " (" + computation + ")";
  }
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

// The distance takes the product of both lengths; longer texts are not names.
constexpr std::size_t kLongestName = 200;  // [bytes]

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
  if (name.size() > kLongestName) {
    return "";
  }
  // More than a third of the letters wrong is another word, not a misspelling.
  std::size_t best = name.size() / 3 + 2;
  std::string nearest;
  for (const std::string& candidate : names) {
    if (candidate.size() > 2 * kLongestName) {
      continue;
    }
    const std::size_t distance = calcEditDistance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace gaitmill
