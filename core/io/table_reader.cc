#include "core/io/table_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/file_content.h"
#include "core/io/number_text.h"
#include "core/io/text_cells.h"

namespace gaitmill {

namespace {

// No header seen has more than 30 lines; data never begins later.
constexpr int kMaximumHeaderLines = 500;

bool endsWith(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() &&
         equalsIgnoringCase(text.substr(text.size() - ending.size()), ending);
}

bool containsWord(std::string_view line, std::string_view word) {
  for (std::size_t i = 0; i + word.size() <= line.size(); ++i) {
    if (equalsIgnoringCase(line.substr(i, word.size()), word)) {
      return true;
    }
  }
  return false;
}

/// What the lines before "endheader" said.
struct Header {
  std::string name;
  std::optional<long> row_count;
  std::optional<long> column_count;
  std::optional<bool> in_degrees;
  std::optional<bool> degrees_in_text;
  bool has_version = false;
};

bool hasHeader(std::string_view text) {
  LineReader lines(text);
  while (lines.number() < kMaximumHeaderLines && lines.next()) {
    if (equalsIgnoringCase(trim(lines.line()), "endheader")) {
      return true;
    }
  }
  return false;
}

class TableParser {
 public:
  TableParser(std::string_view text, const std::string& file_name)
      : lines_(text), findings_(file_name) {
    file_.file_name = file_name;
  }

  TableFile parse(bool with_header) {
    if (with_header) {
      readHeader();
      decideAngleUnit();
    }
    readLabels();
    readRows();
    findings_.throwIfAny();
    requireRows();
    compareCounts();
    fillTable();
    return std::move(file_);
  }

 private:
  void readHeader();
  void readHeaderLine(std::string_view line);
  long readCount(std::string_view key, std::string_view value);
  void decideAngleUnit();
  void readLabels();
  void addLabel(const Cell& cell);
  void readRows();
  void readRow();
  bool acceptTime(const Cell& cell, double time);
  void requireRows();
  void compareCounts();
  void fillTable();
  [[noreturn]] void fail(ErrorCode code, const std::string& message, int column) const {
    throw Error(code, message, {file_.file_name, lines_.number(), column, {}});
  }

  LineReader lines_;
  Findings findings_;
  TableFile file_;
  Header header_;
  char separator_ = ' ';  // ' ' stands for any mix of blanks and tabs
  std::vector<Cell> cells_;
  std::vector<double> values_;
  int dropped_rows_ = 0;
};

long TableParser::readCount(std::string_view key, std::string_view value) {
  const std::optional<long> count = parseInteger(value);
  if (!count || *count < 0) {
    fail(ErrorCode::kTableHeader,
         std::string(key) + " is '" + std::string(value) + "', expected a count",
         1);
  }
  return *count;
}

// Angle statements in free text count only where they are one: the usual remark about the inDegrees
// line names both units.
std::optional<bool> findUnitInText(std::string_view line) {
  const bool degrees = containsWord(line, "degrees");
  const bool radians = containsWord(line, "radians");
  return degrees != radians ? std::optional<bool>(degrees) : std::nullopt;
}

void TableParser::readHeaderLine(std::string_view line) {
  const std::size_t end = std::min(line.find_first_of(" \t="), line.size());
  const std::string_view key = line.substr(0, end);
  std::string_view value = trim(line.substr(end));
  if (!value.empty() && value.front() == '=') {
    value = trim(value.substr(1));
  }
  const auto is = [&](std::string_view name) {
    return equalsIgnoringCase(key, name);
  };
  if (is("nRows") || is("nr") || is("datarows")) {
    header_.row_count = readCount(key, value);
  } else if (is("nColumns") || is("nc") || is("datacolumns")) {
    header_.column_count = readCount(key, value);
  } else if (is("inDegrees")) {
    header_.in_degrees = parseBoolean(value);
    if (!header_.in_degrees) {
      fail(ErrorCode::kTableHeader,
           "inDegrees is '" + std::string(value) + "', expected yes or no",
           1);
    }
  } else if (is("DataType") && !equalsIgnoringCase(value, "double")) {
    fail(ErrorCode::kTableHeader,
         "tables of type '" + std::string(value) + "' cannot be read, only of type double",
         1);
  } else if (is("version")) {
    header_.has_version = true;
  } else if (is("name")) {
    header_.name = std::string(value);
  } else if (lines_.number() == 1) {
    header_.name = std::string(line);
  } else if (const std::optional<bool> unit = findUnitInText(line)) {
    header_.degrees_in_text = unit;
  }
}

void TableParser::readHeader() {
  while (lines_.next()) {
    const std::string_view line = trim(lines_.line());
    if (equalsIgnoringCase(line, "endheader")) {
      file_.table.name = header_.name;
      return;
    }
    readHeaderLine(line);
  }
}

void TableParser::decideAngleUnit() {
  if (header_.in_degrees) {
    file_.in_degrees = *header_.in_degrees;
    file_.degrees_stated = true;
  } else if (!header_.has_version && header_.degrees_in_text) {
    file_.in_degrees = *header_.degrees_in_text;
    file_.degrees_stated = true;
  } else {
    file_.in_degrees = endsWith(file_.file_name, ".mot");
  }
}

void TableParser::addLabel(const Cell& cell) {
  std::string_view text = cell.text;
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = trim(text.substr(1, text.size() - 2));
  }
  std::string unit;
  const std::size_t bracket = text.find_last_of('[');
  if (separator_ == ',' && bracket != std::string_view::npos && text.back() == ']') {
    unit = std::string(text.substr(bracket + 1, text.size() - bracket - 2));
    unit = unit == "1" ? "" : unit;
    text = trim(text.substr(0, bracket));
  }
  if (text.empty()) {
    fail(ErrorCode::kTableLabels, "a column has no label", cell.column);
  }
  file_.table.labels.emplace_back(text);
  file_.table.units.push_back(unit);
  file_.label_columns.push_back(cell.column);
}

void TableParser::readLabels() {
  do {
    if (!lines_.next()) {
      fail(ErrorCode::kTableLabels, "the file ends before the column labels", 0);
    }
  } while (trim(lines_.line()).empty());
  file_.label_line = lines_.number();
  const std::string_view line = lines_.line();
  const bool has_comma = line.find(',') != std::string_view::npos;
  const bool has_tab = line.find('\t') != std::string_view::npos;
  separator_ = has_comma && !has_tab ? ',' : ' ';
  if (has_tab || has_comma) {
    splitAt(has_tab ? '\t' : ',', line, cells_);
    dropEmptyTail(cells_);
  } else {
    splitAtBlanks(line, cells_);
  }
  if (cells_.empty() || cells_.size() > kMaximumCells) {
    fail(ErrorCode::kTableLabels,
         cells_.empty() ? "the line of the labels has none"
                        : "the table has more than " + std::to_string(kMaximumCells) + " columns",
         1);
  }
  for (const Cell& cell : cells_) {
    addLabel(cell);
  }
  const std::string first = file_.table.labels.front();
  if (!equalsIgnoringCase(first, "time") && !equalsIgnoringCase(first, "range")) {
    fail(ErrorCode::kTableLabels,
         "the first column is '" + first + "', expected 'time'",
         cells_.front().column);
  }
  if (const std::string& unit = file_.table.units.front(); !unit.empty() && unit != "s") {
    fail(ErrorCode::kTableLabels, "time is in '" + unit + "', expected s", cells_.front().column);
  }
  file_.table.labels.erase(file_.table.labels.begin());
  file_.table.units.erase(file_.table.units.begin());
  file_.label_columns.erase(file_.label_columns.begin());
  std::unordered_set<std::string> seen;
  for (std::size_t i = 0; i < file_.table.labels.size(); ++i) {
    if (!seen.insert(file_.table.labels[i]).second) {
      fail(ErrorCode::kTableDuplicateLabel,
           "column '" + file_.table.labels[i] + "' stands twice",
           file_.label_columns[i]);
    }
  }
}

bool TableParser::acceptTime(const Cell& cell, double time) {
  if (!std::isfinite(time)) {
    findings_.add(
        ErrorCode::kTableNumber, "a row has no time", lines_.number(), cell.column, "time");
    return false;
  }
  if (file_.table.time.empty() || time > file_.table.time.back()) {
    return true;
  }
  if (time < file_.table.time.back()) {
    findings_.add(ErrorCode::kTableTimeOrder,
                  "time goes back from " + formatNumber(file_.table.time.back()) + " to " +
                      formatNumber(time) + " s",
                  lines_.number(),
                  cell.column,
                  "time");
  } else {
    ++dropped_rows_;
  }
  return false;
}

void TableParser::readRow() {
  if (separator_ == ',') {
    splitAt(',', lines_.line(), cells_);
  } else {
    splitAtBlanks(lines_.line(), cells_);
  }
  const std::size_t expected = file_.table.labels.size() + 1;
  if (cells_.size() == expected + 1 && cells_.back().text.empty()) {
    cells_.pop_back();
  }
  if (cells_.size() != expected) {
    const std::size_t at = std::min(cells_.size(), expected);
    findings_.add(ErrorCode::kTableColumnCount,
                  "row has " + std::to_string(cells_.size()) + " values, the labels need " +
                      std::to_string(expected),
                  lines_.number(),
                  at < cells_.size() ? cells_[at].column : cells_.back().column);
    return;
  }
  const std::size_t row_begin = values_.size();
  double time = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const std::optional<double> value =
        cell.text.empty() ? std::numeric_limits<double>::quiet_NaN() : parseNumber(cell.text);
    if (!value) {
      findings_.add(ErrorCode::kTableNumber,
                    "'" + std::string(cell.text) + "' is not a number",
                    lines_.number(),
                    cell.column,
                    i == 0 ? "time" : file_.table.labels[i - 1]);
      values_.resize(row_begin);
      return;
    }
    if (i == 0) {
      time = *value;
    } else {
      values_.push_back(*value);
    }
  }
  if (acceptTime(cells_.front(), time)) {
    file_.table.time.push_back(time);
    file_.row_lines.push_back(lines_.number());
  } else {
    values_.resize(row_begin);
  }
}

void TableParser::readRows() {
  while (!findings_.isFull() && lines_.next()) {
    if (!trim(lines_.line()).empty()) {
      readRow();
    }
  }
}

void TableParser::requireRows() {
  require(!file_.table.time.empty(),
          ErrorCode::kTableNoRows,
          "the table has labels but no rows",
          {file_.file_name, file_.label_line, 1, {}});
}

void TableParser::compareCounts() {
  const long rows = file_.table.rowCount() + dropped_rows_;
  const long columns = file_.table.columnCount() + 1;
  if (header_.row_count && *header_.row_count != rows) {
    file_.warnings.push_back("the header states " + std::to_string(*header_.row_count) +
                             " rows, the file has " + std::to_string(rows));
  }
  if (header_.column_count && *header_.column_count != columns) {
    file_.warnings.push_back("the header states " + std::to_string(*header_.column_count) +
                             " columns, the file has " + std::to_string(columns));
  }
  if (dropped_rows_ > 0) {
    file_.warnings.push_back(std::to_string(dropped_rows_) +
                             " rows repeated the time of the row before and were dropped");
  }
}

void TableParser::fillTable() {
  file_.table.values = Eigen::Map<const RowMatrix>(
      values_.data(), file_.table.rowCount(), file_.table.columnCount());
  const bool any_unit = std::any_of(file_.table.units.begin(),
                                    file_.table.units.end(),
                                    [](const std::string& unit) { return !unit.empty(); });
  if (!any_unit) {
    file_.table.units.clear();
  }
}

}  // namespace

TableFile readTable(std::string_view bytes, const std::string& file_name) {
  requireData(bytes, file_name);
  const std::string_view text = skipByteOrderMark(bytes);
  return TableParser(text, file_name).parse(hasHeader(text));
}

ColumnName parseColumnName(const std::string& label) {
  struct Suffix {
    std::string_view text;
    ColumnName::Kind kind;
  };
  constexpr Suffix kSuffixes[] = {{"/value", ColumnName::Kind::kValue},
                                  {"/speed", ColumnName::Kind::kSpeed},
                                  {"/activation", ColumnName::Kind::kActivation},
                                  {"/fiber_length", ColumnName::Kind::kFiberLength},
                                  {".activation", ColumnName::Kind::kActivation},
                                  {".fiber_length", ColumnName::Kind::kFiberLength},
                                  {"_u", ColumnName::Kind::kSpeed}};
  for (const Suffix& suffix : kSuffixes) {
    if (label.size() > suffix.text.size() && endsWith(label, suffix.text)) {
      const std::string path = label.substr(0, label.size() - suffix.text.size());
      return {suffix.kind, path.substr(path.find_last_of('/') + 1)};
    }
  }
  return {ColumnName::Kind::kPlain, label};
}

std::string findCoordinateUnit(const ModelSpec& model, const std::string& coordinate) {
  const MotionKind kind = findMotionKind(model, coordinate);
  if (kind != MotionKind::kCoupled) {
    return kind == MotionKind::kRotational ? "rad" : "m";
  }
  for (const JointSpec& joint : model.joints) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (joint.axes[i].coordinate == coordinate) {
        return "rad";
      }
    }
  }
  return "m";
}

namespace {

/// Coordinate that a label names, or "".
std::string findCoordinateOfLabel(const std::string& label, const ModelSpec& model) {
  if (model.findCoordinate(label) != nullptr) {
    return label;
  }
  const ColumnName column = parseColumnName(label);
  const bool is_value = column.kind == ColumnName::Kind::kValue;
  return is_value && model.findCoordinate(column.name) != nullptr ? column.name : "";
}

Where whereLabel(const TableFile& file, std::size_t column) {
  return {file.file_name, file.label_line, file.label_columns[column], file.table.labels[column]};
}

// A unit at the column's own label beats the file's header.
bool isInDegrees(const TableFile& file,
                 std::size_t column,
                 const std::string& coordinate,
                 const ModelSpec& model) {
  const std::string unit = file.table.units.empty() ? "" : file.table.units[column];
  if (!unit.empty()) {
    return unit == "deg";
  }
  return file.in_degrees && findMotionKind(model, coordinate) == MotionKind::kRotational;
}

[[noreturn]] void failUnknownLabel(const TableFile& file,
                                   std::size_t column,
                                   const ModelSpec& model) {
  std::vector<std::string> names;
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      names.push_back(coordinate.name);
    }
  }
  const std::string nearest =
      findNearestName(parseColumnName(file.table.labels[column]).name, names);
  throw Error(ErrorCode::kTableUnknownLabel,
              "the model has no coordinate '" + file.table.labels[column] + "'" +
                  (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"),
              whereLabel(file, column));
}

}  // namespace

TimeSeries toCoordinates(const TableFile& file,
                         const ModelSpec& model,
                         std::vector<std::string>* ignored) {
  TimeSeries result{file.table.name, {}, {}, file.table.time, {}};
  std::vector<Eigen::Index> sources;
  for (std::size_t i = 0; i < file.table.labels.size(); ++i) {
    const std::string name = findCoordinateOfLabel(file.table.labels[i], model);
    if (name.empty()) {
      if (ignored == nullptr) {
        failUnknownLabel(file, i, model);
      }
      ignored->push_back(file.table.labels[i]);
      continue;
    }
    require(!result.findColumn(name),
            ErrorCode::kTableDuplicateLabel,
            "a second column for coordinate '" + name + "'",
            whereLabel(file, i));
    result.labels.push_back(name);
    result.units.push_back(findCoordinateUnit(model, name));
    sources.push_back(static_cast<Eigen::Index>(i));
  }
  require(!sources.empty(),
          ErrorCode::kInputCoordinates,
          "no column of the table is a coordinate of the model",
          {file.file_name, file.label_line, 1, {}});
  result.values.resize(result.rowCount(), result.columnCount());
  for (Eigen::Index i = 0; i < result.values.cols(); ++i) {
    const Eigen::Index source = sources[static_cast<std::size_t>(i)];
    const bool convert = isInDegrees(
        file, static_cast<std::size_t>(source), result.labels[static_cast<std::size_t>(i)], model);
    result.values.col(i) = file.table.values.col(source) * (convert ? kRadiansPerDegree : 1.0);
  }
  return result;
}

}  // namespace gaitmill
