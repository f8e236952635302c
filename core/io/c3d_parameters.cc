#include "core/io/c3d_parameters.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace gaitmill {

namespace {

std::string toUpper(std::string_view text) {
  std::string upper(text);
  for (char& c : upper) {
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return upper;
}

/// Length of the UTF-8 character that begins at `at`, 0 if none does.
std::size_t measureCharacter(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = lead < 0x80                   ? 1
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                                                           : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (at + i >= text.size() || (static_cast<unsigned char>(text[at + i]) & 0xC0U) != 0x80U) {
      return 0;
    }
  }
  return length;
}

/// Text as UTF-8: as it is where it can be that, else taken for Latin-1, as the format's years had
/// it. Control characters become blanks.
std::string toUtf8(std::string_view text) {
  bool is_utf8 = true;
  for (std::size_t at = 0; is_utf8 && at < text.size();) {
    const std::size_t length = measureCharacter(text, at);
    is_utf8 = length > 0;
    at += length;
  }
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      utf8 += ' ';
    } else if (is_utf8 || byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xC0U | byte >> 6U);
      utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return utf8;
}

std::string trimPadding(std::string_view text) {
  constexpr std::string_view kPadding(" \t\0", 3);
  const std::size_t begin = text.find_first_not_of(kPadding);
  if (begin == std::string_view::npos) {
    return "";
  }
  return toUtf8(text.substr(begin, text.find_last_not_of(kPadding) + 1 - begin));
}

// There are at most as many points and channels as a word can count.
constexpr std::size_t kMostValues = 65535;

std::string makeKey(std::string_view group, std::string_view name) {
  return toUpper(group) + ':' + toUpper(name);
}

/// Walks through the records, gathering groups and parameters; a parameter may precede its group.
class RecordReader {
 public:
  RecordReader(const C3dBytes& file, std::size_t begin, std::size_t end)
      : file_(file), at_(begin), end_(std::min(end, file.all().size())) {}

  /// False after the last record.
  bool next() {
    if (last_ || at_ >= end_ || end_ - at_ < kSmallestRecord) {
      return false;
    }
    const auto signed_length = static_cast<signed char>(file_.all()[at_]);
    const auto length = static_cast<std::size_t>(std::abs(static_cast<int>(signed_length)));
    if (length == 0 || end_ - at_ < kSmallestRecord + length) {
      return false;
    }
    id_ = static_cast<signed char>(file_.all()[at_ + 1]);
    name_ = toUpper(trimPadding(file_.all().substr(at_ + 2, length)));
    body_ = at_ + 2 + length;
    const std::size_t step = file_.word(body_);
    last_ = step == 0;
    at_ = body_ + step;
    // A record without even its own offset field would be read for ever.
    last_ = last_ || step < 2;
    // What a record holds lies before the next one, or one file could claim each byte many times.
    body_end_ = last_ ? end_ : std::min(at_, end_);
    return true;
  }

  int id() const { return id_; }
  const std::string& name() const { return name_; }
  /// The parameter of the record, or nullopt if its values do not lie within the section.
  std::optional<C3dParameter> parameter() const;

 private:
  static constexpr std::size_t kSmallestRecord = 4;  // length, id, offset

  const C3dBytes& file_;
  std::size_t at_;
  std::size_t end_;
  std::size_t body_ = 0;  // of the offset field
  std::size_t body_end_ = 0;
  bool last_ = false;
  int id_ = 0;
  std::string name_;
};

std::optional<C3dParameter> RecordReader::parameter() const {
  std::size_t at = body_ + 2;
  if (at + 2 > body_end_) {
    return std::nullopt;
  }
  C3dParameter parameter;
  parameter.type = static_cast<signed char>(file_.all()[at]);
  if (parameter.type != -1 && parameter.type != 1 && parameter.type != 2 && parameter.type != 4) {
    return std::nullopt;
  }
  const auto dimension_count =
      static_cast<std::size_t>(static_cast<unsigned char>(file_.all()[at + 1]));
  at += 2;
  if (dimension_count > body_end_ - at) {
    return std::nullopt;
  }
  const std::size_t room = body_end_ - at - dimension_count;
  parameter.count = 1;
  for (std::size_t i = 0; i < dimension_count; ++i) {
    const auto dimension = static_cast<unsigned char>(file_.all()[at + i]);
    parameter.dimensions.push_back(dimension);
    parameter.count = std::min(parameter.count * dimension, room + 1);  // no overflow
  }
  parameter.offset = at + dimension_count;
  const auto size = static_cast<std::size_t>(std::abs(parameter.type));
  if (parameter.count > room / size) {
    return std::nullopt;
  }
  return parameter;
}

}  // namespace

long toInteger(double number) {
  constexpr double kLimit = 2147483647.0;
  return number >= -kLimit && number <= kLimit ? static_cast<long>(number) : 0;
}

C3dParameters::C3dParameters(const C3dBytes& file,
                             std::size_t begin,
                             std::size_t end,
                             std::vector<std::string>& warnings)
    : file_(file) {
  std::unordered_map<int, std::string> groups;
  std::vector<std::pair<int, std::pair<std::string, C3dParameter>>> found;
  RecordReader records(file, begin, end);
  std::size_t lost = 0;
  while (records.next()) {
    if (records.id() < 0) {
      groups.emplace(-records.id(), records.name());
    } else if (std::optional<C3dParameter> parameter = records.parameter()) {
      found.emplace_back(records.id(), std::pair(records.name(), *std::move(parameter)));
    } else {
      ++lost;
    }
  }
  for (auto& [id, named] : found) {
    const auto group = groups.find(id);
    if (group != groups.end()) {
      parameters_.emplace(group->second + ':' + named.first, std::move(named.second));
    } else {
      ++lost;
    }
  }
  if (lost > 0) {
    warnings.push_back(std::to_string(lost) +
                       " parameters are cut off, of an unknown type or of no group; they were "
                       "left out");
  }
}

const C3dParameter* C3dParameters::find(std::string_view group, std::string_view name) const {
  const auto found = parameters_.find(makeKey(group, name));
  return found == parameters_.end() ? nullptr : &found->second;
}

std::vector<double> C3dParameters::readNumbers(const C3dParameter* parameter, Words words) const {
  std::vector<double> numbers;
  if (parameter == nullptr || parameter->type == -1) {
    return numbers;
  }
  numbers.reserve(parameter->count);
  for (std::size_t i = 0; i < parameter->count; ++i) {
    const std::size_t at = parameter->offset + i * static_cast<std::size_t>(parameter->type);
    if (parameter->type == 4) {
      numbers.push_back(static_cast<double>(file_.real(at)));
    } else if (parameter->type == 1) {
      numbers.push_back(static_cast<unsigned char>(file_.all()[at]));
    } else {
      const std::uint16_t word = file_.word(at);
      numbers.push_back(words == Words::kSigned ? static_cast<std::int16_t>(word) : word);
    }
  }
  return numbers;
}

std::vector<double> C3dParameters::findNumbers(std::string_view group,
                                               std::string_view name) const {
  return readNumbers(find(group, name), Words::kUnsigned);
}

std::vector<double> C3dParameters::findSignedNumbers(std::string_view group,
                                                     std::string_view name) const {
  return readNumbers(find(group, name), Words::kSigned);
}

std::optional<double> C3dParameters::findNumber(std::string_view group,
                                                std::string_view name) const {
  const std::vector<double> numbers = findNumbers(group, name);
  return numbers.empty() ? std::nullopt : std::optional<double>(numbers[0]);
}

std::vector<std::string> C3dParameters::findTexts(std::string_view group,
                                                  std::string_view name) const {
  std::vector<std::string> texts;
  const C3dParameter* const parameter = find(group, name);
  if (parameter == nullptr || parameter->type != -1) {
    return texts;
  }
  const std::vector<std::size_t>& dimensions = parameter->dimensions;
  const std::size_t length = dimensions.empty() ? 1 : dimensions[0];
  for (std::size_t i = 0;
       length > 0 && i + length <= parameter->count && texts.size() < kMostValues;
       i += length) {
    texts.push_back(trimPadding(file_.all().substr(parameter->offset + i, length)));
  }
  return texts;
}

std::string C3dParameters::findText(std::string_view group, std::string_view name) const {
  const std::vector<std::string> texts = findTexts(group, name);
  return texts.empty() ? "" : texts[0];
}

namespace {

// The values of name, name2, name3, ... one after another.
template <class Find>
auto joinOverflow(const std::string& name, Find find) {
  auto all = find(name);
  for (int i = 2;; ++i) {
    const auto more = find(name + std::to_string(i));
    if (more.empty() || all.size() > kMostValues) {
      return all;
    }
    all.insert(all.end(), more.begin(), more.end());
  }
}

}  // namespace

std::vector<std::string> C3dParameters::findAllTexts(std::string_view group,
                                                     const std::string& name) const {
  return joinOverflow(name, [&](const std::string& n) { return findTexts(group, n); });
}

std::vector<double> C3dParameters::findAllNumbers(std::string_view group,
                                                  const std::string& name) const {
  return joinOverflow(name, [&](const std::string& n) { return findNumbers(group, n); });
}

std::vector<double> C3dParameters::findAllSignedNumbers(std::string_view group,
                                                        const std::string& name) const {
  return joinOverflow(name, [&](const std::string& n) { return findSignedNumbers(group, n); });
}

}  // namespace gaitmill
