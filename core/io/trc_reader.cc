#include "core/io/trc_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/base/error.h"
#include "core/io/file_content.h"
#include "core/io/number_text.h"
#include "core/io/text_cells.h"

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFirstMarkerCell = 2;  // after frame number and time

/// Decimals of a printed number, zeros at the end not counted: 3 for "0.017000".
int countDecimals(std::string_view number) {
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) {
    return 0;
  }
  return static_cast<int>(number.find_last_not_of('0') - point);
}

class TrcParser {
 public:
  TrcParser(std::string_view text, const std::string& file_name, const TrcOptions& options)
      : lines_(text), file_name_(file_name), options_(options), findings_(file_name) {}

  TrcFile parse() {
    readFileType();
    readHeaderValues();
    readNames();
    readRows();
    findings_.throwIfAny();
    finishTimes();
    compareCounts();
    fillPositions();
    return std::move(file_);
  }

 private:
  void nextLine(const char* expected);
  void readFileType();
  void readHeaderValues();
  void readHeaderValue(std::string_view key, const Cell& value);
  void readUnits(const Cell& value);
  void readNames();
  void keepMarker(const Cell& cell, std::size_t index);
  void readRows();
  bool isHeading() const;
  void readRow();
  bool readMarkers();
  void readMarker(std::size_t marker);
  void finishTimes();
  void rebuildTimes();
  bool areTimesRounded() const;
  void compareCounts();
  void fillPositions();
  void warn(const std::string& sentence) { file_.warnings.push_back(sentence); }
  [[noreturn]] void fail(ErrorCode code, const std::string& message, int column) const {
    throw Error(code, message, {file_name_, lines_.number(), column, {}});
  }

  LineReader lines_;
  std::string file_name_;
  TrcOptions options_;
  Findings findings_;
  TrcFile file_;
  std::vector<Cell> cells_;
  std::optional<long> stated_frames_;
  std::optional<long> stated_markers_;
  double units_per_metre_ = 0;
  std::unordered_set<std::string> known_names_;
  std::vector<std::size_t> sources_;  // triple of the row that each kept marker has
  std::size_t triple_count_ = 0;
  std::vector<double> values_;
  int time_decimals_ = 0;
  std::vector<int> zero_counts_;
};

void TrcParser::nextLine(const char* expected) {
  if (!lines_.next()) {
    throw Error(ErrorCode::kTrcHeader,
                std::string("the file ends before ") + expected,
                {file_name_, lines_.number() + 1, 1, {}});
  }
}

void TrcParser::readFileType() {
  nextLine("its first line");
  splitAtBlanks(lines_.line(), cells_);
  if (cells_.empty() || cells_[0].text != "PathFileType") {
    fail(ErrorCode::kTrcHeader, "a marker file begins with PathFileType", 1);
  }
}

void TrcParser::readUnits(const Cell& value) {
  if (equalsIgnoringCase(value.text, "m") || equalsIgnoringCase(value.text, "meters")) {
    units_per_metre_ = 1.0;
    file_.units = "m";
  } else if (equalsIgnoringCase(value.text, "mm")) {
    units_per_metre_ = 1000.0;
    file_.units = "mm";
  } else if (equalsIgnoringCase(value.text, "cm")) {
    units_per_metre_ = 100.0;
    file_.units = "cm";
  } else {
    fail(ErrorCode::kTrcUnits,
         "Units is '" + std::string(value.text) + "', expected m, cm or mm",
         value.column);
  }
}

void TrcParser::readHeaderValue(std::string_view key, const Cell& value) {
  if (key == "Units") {
    readUnits(value);
    return;
  }
  const std::optional<double> number = parseNumber(value.text);
  if (!number) {
    fail(ErrorCode::kTrcHeader,
         std::string(key) + " is '" + std::string(value.text) + "', expected a number",
         value.column);
  }
  if (key == "DataRate") {
    if (!(*number >= 0) || !std::isfinite(*number)) {
      fail(ErrorCode::kTrcHeader, "DataRate cannot be " + formatNumber(*number), value.column);
    }
    file_.markers.rate = *number;
  } else if (key == "NumFrames" && std::abs(*number) < 1e15) {
    stated_frames_ = std::lround(*number);
  } else if (key == "NumMarkers" && std::abs(*number) < 1e15) {
    stated_markers_ = std::lround(*number);
  }
}

void TrcParser::readHeaderValues() {
  nextLine("the header keys");
  std::vector<Cell> keys;
  splitAtBlanks(lines_.line(), keys);
  const bool has_units =
      std::any_of(keys.begin(), keys.end(), [](const Cell& cell) { return cell.text == "Units"; });
  if (keys.empty() || keys[0].text != "DataRate" || !has_units) {
    fail(ErrorCode::kTrcHeader,
         "the second line names DataRate, CameraRate, NumFrames, NumMarkers, Units and three more",
         1);
  }
  nextLine("the header values");
  splitAtBlanks(lines_.line(), cells_);
  if (cells_.size() < keys.size()) {
    fail(ErrorCode::kTrcHeader,
         "the header has " + std::to_string(cells_.size()) + " values for " +
             std::to_string(keys.size()) + " keys",
         cells_.empty() ? 1 : cells_.back().column);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    readHeaderValue(keys[i].text, cells_[i]);
  }
}

void TrcParser::keepMarker(const Cell& cell, std::size_t index) {
  std::string name(cell.text);
  const std::size_t colon = name.find(':');
  if (options_.prefixes == TrcOptions::Prefixes::kStrip && colon != std::string::npos) {
    name.erase(0, colon + 1);
  }
  if (name.empty() || name.front() == '*') {
    warn("marker " + std::to_string(index + 1) + " ('" + std::string(cell.text) +
         "') is unlabelled and was dropped");
    return;
  }
  if (!known_names_.insert(name).second) {
    warn("marker '" + name + "' stands twice; the first was kept");
    return;
  }
  file_.markers.names.push_back(name);
  sources_.push_back(index);
}

void TrcParser::readNames() {
  nextLine("the marker names");
  splitAt('\t', lines_.line(), cells_);
  dropEmptyTail(cells_);
  if (cells_.size() > kMaximumCells) {
    fail(ErrorCode::kTrcMarkerNames,
         "the fourth line has more than " + std::to_string(kMaximumCells) + " cells",
         1);
  }
  if (cells_.size() < 2 || cells_[0].text.substr(0, 5) != "Frame" || cells_[1].text != "Time") {
    fail(ErrorCode::kTrcMarkerNames,
         "the fourth line begins with Frame#, Time, separated by tabs",
         1);
  }
  for (std::size_t i = kFirstMarkerCell; i < cells_.size(); ++i) {
    if (!cells_[i].text.empty()) {
      keepMarker(cells_[i], triple_count_);
      ++triple_count_;
    }
  }
  if (sources_.empty()) {
    fail(ErrorCode::kTrcMarkerNames, "the fourth line names no marker", 1);
  }
  zero_counts_.assign(sources_.size(), 0);
}

// Line 5 (X1 Y1 Z1 ...) and blank lines, wherever they stand before the data.
bool TrcParser::isHeading() const {
  const std::string_view line = trim(lines_.line());
  return line.empty() || (file_.markers.time.empty() && line.front() == 'X');
}

void TrcParser::readMarker(std::size_t marker) {
  std::array<double, 3> p = {kNaN, kNaN, kNaN};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Cell& cell = cells_[kFirstMarkerCell + 3 * sources_[marker] + axis];
    const std::optional<double> value =
        cell.text.empty() ? std::optional<double>(kNaN) : parseNumber(cell.text);
    if (!value) {
      findings_.add(ErrorCode::kTrcNumber,
                    "'" + std::string(cell.text) + "' is not a number",
                    lines_.number(),
                    cell.column,
                    file_.markers.names[marker]);
      return;
    }
    p[axis] = *value / units_per_metre_;
  }
  const bool zero = p[0] == 0 && p[1] == 0 && p[2] == 0;
  if (zero && options_.zeros == TrcOptions::Zeros::kMissing) {
    ++zero_counts_[marker];
    p.fill(kNaN);
  }
  if (!std::isfinite(p[0] + p[1] + p[2])) {
    p.fill(kNaN);
  }
  values_.insert(values_.end(), p.begin(), p.end());
}

bool TrcParser::readMarkers() {
  const std::size_t expected = kFirstMarkerCell + 3 * triple_count_;
  if (cells_.size() < expected && lines_.atEnd()) {
    warn("line " + std::to_string(lines_.number()) + ": the last row is cut off and was dropped");
    return false;
  }
  if (cells_.size() > expected) {
    const bool only_empty = std::all_of(cells_.begin() + static_cast<std::ptrdiff_t>(expected),
                                        cells_.end(),
                                        [](const Cell& cell) { return cell.text.empty(); });
    if (only_empty) {
      cells_.resize(expected);
    }
  }
  if (cells_.size() != expected) {
    const std::size_t at = std::min(cells_.size() - 1, expected);
    findings_.add(ErrorCode::kTrcColumnCount,
                  "row has " + std::to_string(cells_.size()) + " cells, " +
                      std::to_string(triple_count_) + " markers need " + std::to_string(expected),
                  lines_.number(),
                  cells_[at].column);
    return false;
  }
  const std::size_t begin = values_.size();
  for (std::size_t marker = 0; marker < sources_.size(); ++marker) {
    readMarker(marker);
  }
  if (values_.size() != begin + 3 * sources_.size()) {
    values_.resize(begin);
    return false;
  }
  return true;
}

void TrcParser::readRow() {
  const std::optional<long> frame = parseInteger(cells_[0].text);
  if (!frame) {
    findings_.add(ErrorCode::kTrcNumber,
                  "'" + std::string(cells_[0].text) + "' is not a frame number",
                  lines_.number(),
                  cells_[0].column,
                  "Frame#");
    return;
  }
  const bool has_time = cells_.size() > 1;
  const std::optional<double> time = has_time ? parseNumber(cells_[1].text) : std::nullopt;
  if (has_time && (!time || !std::isfinite(*time))) {
    findings_.add(ErrorCode::kTrcNumber,
                  "'" + std::string(cells_[1].text) + "' is not a time",
                  lines_.number(),
                  cells_[1].column,
                  "Time");
    return;
  }
  if (readMarkers()) {
    file_.markers.time.push_back(*time);
    time_decimals_ = std::max(time_decimals_, countDecimals(cells_[1].text));
  }
}

void TrcParser::readRows() {
  while (!findings_.isFull() && lines_.next()) {
    splitAt('\t', lines_.line(), cells_);
    if (!isHeading()) {
      readRow();
    }
  }
  if (file_.markers.time.empty()) {
    findings_.throwIfAny();
    throw Error(
        ErrorCode::kTrcNoRows, "the file has no frames", {file_name_, lines_.number(), 1, {}});
  }
}

// Some programs round to 1 ms and print six decimals, so the resolution is the last decimal that is
// not zero in any row.
bool TrcParser::areTimesRounded() const {
  const std::vector<double>& time = file_.markers.time;
  const double half_unit = 0.5 * std::pow(10.0, -time_decimals_);
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double regular = time[0] + static_cast<double>(k) / file_.markers.rate;
    // The small excess absorbs the binary rounding of decimal numbers.
    if (!(std::abs(time[k] - regular) <= half_unit * (1.0 + 1e-8) + 1e-12)) {
      return false;
    }
  }
  return true;
}

void TrcParser::rebuildTimes() {
  std::vector<double>& time = file_.markers.time;
  for (std::size_t k = 1; k < time.size(); ++k) {
    time[k] = time[0] + static_cast<double>(k) / file_.markers.rate;
  }
  // A rate of 1e300 Hz, or a start at 1e300 s, leaves nothing between two frames.
  require(std::adjacent_find(time.begin(), time.end(), std::greater_equal<>()) == time.end(),
          ErrorCode::kTrcTimeOrder,
          "times that start at " + formatNumber(time[0]) + " s do not increase at " +
              formatNumber(file_.markers.rate) + " Hz",
          {file_name_, 3, 1, "DataRate"});
}

void TrcParser::finishTimes() {
  const std::vector<double>& time = file_.markers.time;
  const auto back = std::adjacent_find(time.begin(), time.end(), std::greater_equal<>());
  const double rate = file_.markers.rate;
  if (back != time.end()) {
    const auto row = static_cast<int>(back - time.begin()) + 1;
    require(rate > 0,
            ErrorCode::kTrcTimeOrder,
            "time does not increase at frame " + std::to_string(row + 1) +
                " and the header states no DataRate",
            {file_name_, 3, 1, "Time"});
    warn("times do not increase at frame " + std::to_string(row + 1) +
         "; they were rebuilt from DataRate " + formatNumber(rate));
    rebuildTimes();
    return;
  }
  if (time.size() < 2 || rate <= 0) {
    return;
  }
  if (areTimesRounded()) {
    if (options_.times == TrcOptions::Times::kRegular) {
      rebuildTimes();
    }
    return;
  }
  const double measured = static_cast<double>(time.size() - 1) / (time.back() - time.front());
  if (std::abs(measured - rate) > 0.01 * rate) {
    warn("the header states " + formatNumber(rate) + " Hz, the times show " +
         formatNumber(measured) + " Hz");
  }
}

void TrcParser::compareCounts() {
  if (stated_frames_ && *stated_frames_ != file_.markers.frameCount()) {
    warn("the header states " + std::to_string(*stated_frames_) + " frames, the file has " +
         std::to_string(file_.markers.frameCount()));
  }
  if (stated_markers_ && *stated_markers_ != static_cast<long>(triple_count_)) {
    warn("the header states " + std::to_string(*stated_markers_) + " markers, the file names " +
         std::to_string(triple_count_));
  }
  for (std::size_t i = 0; i < zero_counts_.size(); ++i) {
    if (zero_counts_[i] > 0) {
      warn("marker '" + file_.markers.names[i] + "' is exactly 0, 0, 0 in " +
           std::to_string(zero_counts_[i]) + " frames, taken as missing");
    }
  }
}

void TrcParser::fillPositions() {
  file_.markers.positions = Eigen::Map<const RowMatrix>(
      values_.data(), file_.markers.frameCount(), Eigen::Index{3} * file_.markers.markerCount());
}

}  // namespace

TrcFile readTrc(std::string_view bytes, const std::string& file_name, const TrcOptions& options) {
  requireData(bytes, file_name);
  return TrcParser(skipByteOrderMark(bytes), file_name, options).parse();
}

}  // namespace gaitmill
