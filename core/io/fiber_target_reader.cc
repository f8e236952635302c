#include "core/io/fiber_target_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/io/file_content.h"
#include "core/io/number_text.h"
#include "core/io/text_cells.h"

namespace gaitmill {

namespace {

// Where each column stands, -1 = not in this file.
struct Columns {
  int muscle = -1;
  int norm_fiber_length = -1;
  int fiber_length = -1;
  std::size_t count = 0;
};

bool nextContent(LineReader& lines, std::vector<Cell>& cells) {
  while (lines.next()) {
    const std::string_view text = trim(lines.line());
    if (!text.empty() && text.front() != '#') {
      splitAt(',', lines.line(), cells);
      return true;
    }
  }
  return false;
}

Columns readHeader(const std::vector<Cell>& cells, int line, Findings& findings) {
  Columns columns;
  columns.count = cells.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    int* column = cells[i].text == "muscle"              ? &columns.muscle
                  : cells[i].text == "norm_fiber_length" ? &columns.norm_fiber_length
                  : cells[i].text == "fiber_length_m"    ? &columns.fiber_length
                                                         : nullptr;
    if (column == nullptr) {
      findings.add(ErrorCode::kTableLabels,
                   "column '" + std::string(cells[i].text) +
                       "' is not one of muscle, norm_fiber_length, fiber_length_m",
                   line,
                   cells[i].column);
    } else if (*column >= 0) {
      findings.add(ErrorCode::kTableDuplicateLabel,
                   "column '" + std::string(cells[i].text) + "' stands twice",
                   line,
                   cells[i].column);
    } else {
      *column = static_cast<int>(i);
    }
    if (findings.isFull()) {
      break;
    }
  }
  findings.throwIfAny();
  if (columns.muscle < 0 || (columns.norm_fiber_length < 0 && columns.fiber_length < 0)) {
    findings.add(ErrorCode::kTableLabels,
                 "the first line must name the columns muscle and norm_fiber_length or "
                 "fiber_length_m",
                 line,
                 1);
    findings.throwIfAny();
  }
  return columns;
}

// A length of a row, nothing if its cell is empty or wrong.
std::optional<double> readLength(const Cell& cell, int line, Findings& findings) {
  if (cell.text.empty()) {
    return std::nullopt;
  }
  const std::optional<double> value = parseNumber(cell.text);
  if (!value || !std::isfinite(*value)) {
    findings.add(ErrorCode::kTableNumber,
                 "'" + std::string(cell.text) + "' is not a number",
                 line,
                 cell.column);
    return std::nullopt;
  }
  if (*value <= 0) {
    findings.add(ErrorCode::kInputValue, "a fiber length must be positive", line, cell.column);
  }
  return value;
}

void readRow(const std::vector<Cell>& cells,
             const Columns& columns,
             int line,
             Findings& findings,
             std::vector<FiberTarget>& targets) {
  if (cells.size() != columns.count) {
    findings.add(ErrorCode::kTableColumnCount,
                 "the row has " + std::to_string(cells.size()) + " cells, the header names " +
                     std::to_string(columns.count) + " columns",
                 line,
                 1);
    return;
  }
  const auto cellAt = [&cells](int column) {
    return cells[static_cast<std::size_t>(column)];
  };
  const auto lengthAt = [&](int column) {
    return column < 0 ? std::nullopt : readLength(cellAt(column), line, findings);
  };
  FiberTarget target;
  target.muscle = std::string(cellAt(columns.muscle).text);
  target.line = line;
  const std::optional<double> norm = lengthAt(columns.norm_fiber_length);
  const std::optional<double> length = lengthAt(columns.fiber_length);
  if (target.muscle.empty()) {
    findings.add(ErrorCode::kInputValue, "the row names no muscle", line, 1);
  } else if (norm.has_value() == length.has_value()) {
    findings.add(ErrorCode::kInputValue,
                 "muscle '" + target.muscle +
                     "' needs either norm_fiber_length or fiber_length_m, not both or none",
                 line,
                 1);
  }
  target.norm_fiber_length = norm.value_or(target.norm_fiber_length);
  target.fiber_length = length.value_or(target.fiber_length);
  targets.push_back(target);
}

}  // namespace

std::vector<FiberTarget> readFiberTargets(std::string_view bytes, const std::string& file_name) {
  requireData(bytes, file_name);
  Findings findings(file_name);
  LineReader lines(skipByteOrderMark(bytes));
  std::vector<Cell> cells;
  std::vector<FiberTarget> targets;
  if (nextContent(lines, cells)) {
    const Columns columns = readHeader(cells, lines.number(), findings);
    while (!findings.isFull() && nextContent(lines, cells)) {
      readRow(cells, columns, lines.number(), findings, targets);
    }
  }
  findings.throwIfAny();
  if (targets.empty()) {
    findings.add(ErrorCode::kTableNoRows, "the table names no muscle", lines.number(), 1);
    findings.throwIfAny();
  }
  return targets;
}

}  // namespace gaitmill
