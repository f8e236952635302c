#include "core/io/anc_reader.h"

#include <algorithm>
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
constexpr std::string_view kMagic = "File_Type:";
// Four lines of keys and a few empty ones have been seen before the channel names.
constexpr int kMaximumHeaderLines = 100;
constexpr long kMaximumBitDepth = 32;
constexpr double kVoltsPerMillivolt = 1e-3;
// Stated rates are rounded; more than this share apart and they are another rate.
constexpr double kRateTolerance = 1e-3;

class AncParser {
 public:
  AncParser(std::string_view text, const std::string& file_name)
      : lines_(text), file_name_(file_name), findings_(file_name) {}

  AncFile parse() {
    readKeys();
    readNames();
    rates_ = readPositives("Rate");
    ranges_ = readPositives("Range");
    readRows();
    findings_.throwIfAny();
    require(!time_.empty(),
            ErrorCode::kTableNoRows,
            "the file has channels but no rows",
            {file_name_, lines_.number(), 1, {}});
    compareRate();
    fillSignals();
    return std::move(file_);
  }

 private:
  bool nextFilledLine();
  void readKeys();
  void readKey(std::string_view key, const Cell& value);
  void readNames();
  std::vector<double> readPositives(const char* head);
  void readRows();
  void readRow();
  bool readCells();
  bool acceptTime(double time);
  void compareRate();
  void fillSignals();
  [[noreturn]] void fail(ErrorCode code, const std::string& message, int column) const {
    throw Error(code, message, {file_name_, lines_.number(), column, {}});
  }

  LineReader lines_;
  std::string file_name_;
  Findings findings_;
  AncFile file_;
  std::vector<Cell> cells_;
  std::optional<long> bit_depth_;
  std::vector<std::string> names_;
  bool ends_with_tab_ = false;  // the line of the names, and then the rows too
  std::vector<double> rates_;   // [Hz]
  std::vector<double> ranges_;  // [mV]
  std::vector<double> time_;
  std::vector<double> counts_;  // one row after the other
};

// Moves to the next line with text in it, split at tabs.
bool AncParser::nextFilledLine() {
  while (lines_.next()) {
    if (!trim(lines_.line()).empty()) {
      splitAt('\t', lines_.line(), cells_);
      dropEmptyTail(cells_);
      return true;
    }
  }
  return false;
}

void AncParser::readKey(std::string_view key, const Cell& value) {
  if (key == "BitDepth:") {
    bit_depth_ = parseInteger(value.text);
    if (!bit_depth_ || *bit_depth_ < 1 || *bit_depth_ > kMaximumBitDepth) {
      fail(ErrorCode::kEmgHeader,
           "BitDepth is '" + std::string(value.text) + "', expected 1 to 32",
           value.column);
    }
  } else if (key == "PreciseRate:") {
    const std::optional<double> rate = parseNumber(value.text);
    if (!rate || !(*rate > 0) || !std::isfinite(*rate)) {
      fail(ErrorCode::kEmgHeader,
           "PreciseRate is '" + std::string(value.text) + "', expected a positive number of Hz",
           value.column);
    }
    file_.rate = *rate;
  } else if (key == "Polarity:" && !equalsIgnoringCase(value.text, "Bipolar")) {
    fail(ErrorCode::kEmgHeader,
         "Polarity is '" + std::string(value.text) + "'; only bipolar boards can be read",
         value.column);
  }
}

void AncParser::readKeys() {
  while (lines_.number() < kMaximumHeaderLines && nextFilledLine()) {
    if (cells_[0].text == "Name") {
      require(bit_depth_ && file_.rate > 0,
              ErrorCode::kEmgHeader,
              std::string("the header states no ") + (bit_depth_ ? "PreciseRate" : "BitDepth"),
              {file_name_, lines_.number(), 1, {}});
      return;
    }
    for (std::size_t i = 0; i + 1 < cells_.size(); i += 2) {
      readKey(cells_[i].text, cells_[i + 1]);
    }
  }
  fail(ErrorCode::kEmgHeader, "the header has no line that begins with Name", 1);
}

void AncParser::readNames() {
  if (cells_.size() < 2 || cells_.size() > kMaximumCells) {
    fail(ErrorCode::kTableLabels,
         cells_.size() < 2
             ? "the line Name names no channel"
             : "the file has more than " + std::to_string(kMaximumCells) + " channels",
         1);
  }
  ends_with_tab_ = lines_.line().back() == '\t';
  std::unordered_set<std::string> seen;
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    const std::string& name = names_.emplace_back(cells_[i].text);
    if (name.empty()) {
      fail(ErrorCode::kTableLabels, "a channel has no name", cells_[i].column);
    }
    if (!seen.insert(name).second) {
      fail(
          ErrorCode::kTableDuplicateLabel, "channel '" + name + "' stands twice", cells_[i].column);
    }
  }
}

std::vector<double> AncParser::readPositives(const char* head) {
  const std::string name(head);
  if (!nextFilledLine() || cells_[0].text != name) {
    fail(ErrorCode::kEmgHeader, "expected the line that begins with " + name, 1);
  }
  if (cells_.size() != names_.size() + 1) {
    fail(ErrorCode::kEmgHeader,
         "the line " + name + " has " + std::to_string(cells_.size() - 1) + " values for " +
             std::to_string(names_.size()) + " channels",
         cells_[std::min(cells_.size() - 1, names_.size() + 1)].column);
  }
  std::vector<double> values;
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    const std::optional<double> value = parseNumber(cells_[i].text);
    if (!value || !(*value > 0) || !std::isfinite(*value)) {
      fail(ErrorCode::kEmgHeader,
           name + " of channel '" + names_[i - 1] + "' is '" + std::string(cells_[i].text) +
               "', expected a positive number",
           cells_[i].column);
    }
    values.push_back(*value);
  }
  return values;
}

// Appends the counts of a row; false, with a finding, if a cell is no number.
bool AncParser::readCells() {
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    const std::optional<double> count = cells_[i].text.empty() ? kNaN : parseNumber(cells_[i].text);
    if (!count) {
      findings_.add(ErrorCode::kTableNumber,
                    "'" + std::string(cells_[i].text) + "' is not a number",
                    lines_.number(),
                    cells_[i].column,
                    names_[i - 1]);
      return false;
    }
    counts_.push_back(*count);
  }
  return true;
}

bool AncParser::acceptTime(double time) {
  const bool fits = std::isfinite(time) && (time_.empty() || time > time_.back());
  if (!fits) {
    const bool finite = std::isfinite(time);
    findings_.add(
        finite ? ErrorCode::kTableTimeOrder : ErrorCode::kTableNumber,
        finite ? "time goes from " + formatNumber(time_.back()) + " to " + formatNumber(time) + " s"
               : "a row has no time",
        lines_.number(),
        cells_[0].column,
        "time");
  }
  return fits;
}

void AncParser::readRow() {
  splitAt('\t', lines_.line(), cells_);
  const std::size_t expected = names_.size() + 1;
  // Where lines end with a tab, the empty cell behind it is none.
  if (cells_.back().text.empty() && (ends_with_tab_ || cells_.size() == expected + 1)) {
    cells_.pop_back();
  }
  if (cells_.size() != expected) {
    findings_.add(ErrorCode::kTableColumnCount,
                  "row has " + std::to_string(cells_.size()) + " values, time and " +
                      std::to_string(names_.size()) + " channels need " + std::to_string(expected),
                  lines_.number(),
                  cells_.empty() ? 1 : cells_[std::min(cells_.size() - 1, expected)].column);
    return;
  }
  const std::size_t row_begin = counts_.size();
  const double time = parseNumber(cells_[0].text).value_or(kNaN);
  if (acceptTime(time) && readCells()) {
    time_.push_back(time);
  } else {
    counts_.resize(row_begin);
  }
}

void AncParser::readRows() {
  while (!findings_.isFull() && lines_.next()) {
    if (!trim(lines_.line()).empty()) {
      readRow();
    }
  }
}

void AncParser::compareRate() {
  if (time_.size() < 2) {
    return;
  }
  const double measured = static_cast<double>(time_.size() - 1) / (time_.back() - time_.front());
  if (std::abs(measured - file_.rate) > kRateTolerance * file_.rate) {
    file_.warnings.push_back("the header states " + formatNumber(file_.rate) +
                             " Hz, the times of the rows give " + formatNumber(measured) +
                             " Hz; the times count");
    file_.rate = measured;
  }
}

void AncParser::fillSignals() {
  const auto rows = static_cast<Eigen::Index>(time_.size());
  const auto count = static_cast<Eigen::Index>(names_.size());
  const Eigen::Map<const RowMatrix> counts(counts_.data(), rows, count);
  const double common = *std::max_element(rates_.begin(), rates_.end());
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (std::abs(rates_[i] - common) > kRateTolerance * common) {
      file_.warnings.push_back("channel '" + names_[i] + "' is sampled at " +
                               formatNumber(rates_[i]) + " Hz, others at " + formatNumber(common) +
                               " Hz; it was dropped");
    } else {
      kept.push_back(static_cast<Eigen::Index>(i));
      file_.signals.labels.push_back(names_[i]);
    }
  }
  file_.signals.name = "analog";
  file_.signals.units.assign(kept.size(), "V");
  file_.signals.time = std::move(time_);
  file_.signals.values.resize(rows, static_cast<Eigen::Index>(kept.size()));
  const double levels = std::ldexp(1.0, static_cast<int>(*bit_depth_));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double full_scale = 2 * ranges_[static_cast<std::size_t>(kept[i])] * kVoltsPerMillivolt;
    file_.signals.values.col(static_cast<Eigen::Index>(i)) =
        counts.col(kept[i]) * (full_scale / levels);
  }
}

}  // namespace

bool isAnc(std::string_view bytes) {
  return skipByteOrderMark(bytes).substr(0, kMagic.size()) == kMagic;
}

AncFile readAnc(std::string_view bytes, const std::string& file_name) {
  requireData(bytes, file_name);
  const std::string_view text = skipByteOrderMark(bytes);
  require(isAnc(text),
          ErrorCode::kEmgHeader,
          "an analog file begins with File_Type:",
          {file_name, 1, 1, {}});
  return AncParser(text, file_name).parse();
}

}  // namespace gaitmill
