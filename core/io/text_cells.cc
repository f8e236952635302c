#include "core/io/text_cells.h"

#include <algorithm>
#include <utility>

#include "core/io/number_text.h"

namespace gaitmill {

namespace {

Cell makeCell(std::string_view line, std::size_t begin, std::size_t end) {
  const std::string_view raw = line.substr(begin, end - begin);
  const std::string_view text = trim(raw);
  const std::size_t shift = text.empty() ? 0 : static_cast<std::size_t>(text.data() - raw.data());
  return {text, static_cast<int>(begin + shift) + 1};
}

}  // namespace

bool LineReader::next() {
  if (rest_.empty()) {
    return false;
  }
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line_ = rest_.substr(0, end);
  const bool pair = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
  rest_.remove_prefix(std::min(end + (pair ? 2 : 1), rest_.size()));
  ++number_;
  return true;
}

void splitAt(char separator, std::string_view line, std::vector<Cell>& cells) {
  cells.clear();
  std::size_t begin = 0;
  while (cells.size() <= kMaximumCells) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(makeCell(line, begin, end));
    if (end == line.size()) {
      return;
    }
    begin = end + 1;
  }
}

void splitAtBlanks(std::string_view line, std::vector<Cell>& cells) {
  constexpr std::string_view kBlank = " \t\v\f";
  cells.clear();
  std::size_t begin = line.find_first_not_of(kBlank);
  while (begin != std::string_view::npos && cells.size() <= kMaximumCells) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    cells.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    begin = line.find_first_not_of(kBlank, end);
  }
}

void dropEmptyTail(std::vector<Cell>& cells) {
  while (!cells.empty() && cells.back().text.empty()) {
    cells.pop_back();
  }
}

void Findings::add(
    ErrorCode code, const std::string& message, int line, int column, std::string field) {
  errors_.emplace_back(code, message, Where{file_name_, line, column, std::move(field)});
}

void Findings::throwIfAny() const {
  if (errors_.empty()) {
    return;
  }
  Error first = errors_.front();
  for (std::size_t i = 1; i < errors_.size(); ++i) {
    const Where& where = errors_[i].where();
    first.addContext("also line " + std::to_string(where.line) + ", column " +
                     std::to_string(where.column) + ": " + errors_[i].message());
  }
  throw first;
}

}  // namespace gaitmill
