#include "core/io/emg_reader.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/io/anc_reader.h"
#include "core/io/table_reader.h"

namespace gaitmill {

namespace {

// The largest systems have 64; a table of more is something else.
constexpr std::size_t kMaximumChannels = 256;

bool isDigit(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

/// F1X and M12Z, or Fx1 and MZ12.
bool isForceChannel(const std::string& label) {
  constexpr std::size_t kShortest = 3;
  const auto isOneOf = [](char letter, const char* upper) {
    return std::string(upper).find(static_cast<char>(
               std::toupper(static_cast<unsigned char>(letter)))) != std::string::npos;
  };
  if (label.size() < kShortest || !isOneOf(label.front(), "FM")) {
    return false;
  }
  const bool axis_last = isOneOf(label.back(), "XYZ");
  const bool axis_second = isOneOf(label[1], "XYZ");
  const std::string number = axis_last ? label.substr(1, label.size() - 2) : label.substr(2);
  return (axis_last || axis_second) && std::all_of(number.begin(), number.end(), isDigit);
}

/// Of a force plate, an angle, an acceleration: whatever its name, it is no EMG.
bool isOfAnotherQuantity(const std::string& unit) {
  return !unit.empty() && unit != "V";
}

enum class Unit { kAny, kOfEmg };

void dropForceChannels(Unit wanted, EmgFile& file) {
  TimeSeries kept{file.signals.name, {}, {}, std::move(file.signals.time), {}};
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < file.signals.labels.size(); ++i) {
    if (isForceChannel(file.signals.labels[i])) {
      file.force_channels.push_back(file.signals.labels[i]);
      continue;
    }
    if (wanted == Unit::kOfEmg && isOfAnotherQuantity(file.signals.units[i])) {
      continue;
    }
    kept.labels.push_back(file.signals.labels[i]);
    kept.units.push_back(file.signals.units.empty() ? "" : file.signals.units[i]);
    columns.push_back(static_cast<Eigen::Index>(i));
  }
  kept.values.resize(kept.rowCount(), kept.columnCount());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    kept.values.col(static_cast<Eigen::Index>(i)) = file.signals.values.col(columns[i]);
  }
  file.signals = std::move(kept);
}

}  // namespace

EmgFile takeEmg(C3dFile&& file) {
  EmgFile emg;
  emg.format = "c3d";
  emg.signals = std::move(file.analog);
  emg.warnings = std::move(file.warnings);
  dropForceChannels(Unit::kOfEmg, emg);
  return emg;
}

EmgFile readEmg(std::string_view bytes, const std::string& file_name) {
  EmgFile file;
  if (isAnc(bytes)) {
    AncFile analog = readAnc(bytes, file_name);
    file.format = "anc";
    file.signals = std::move(analog.signals);
    file.warnings = std::move(analog.warnings);
  } else if (isC3d(bytes)) {
    file = takeEmg(readC3d(bytes, file_name));
  } else {
    TableFile table = readTable(bytes, file_name);
    file.format = "table";
    file.signals = std::move(table.table);
    file.warnings = std::move(table.warnings);
  }
  dropForceChannels(Unit::kAny, file);
  require(!file.signals.labels.empty(),
          ErrorCode::kEmgChannels,
          "no column beside the time is a channel of muscles",
          {file_name, 0, 0, {}});
  require(file.signals.labels.size() <= kMaximumChannels,
          ErrorCode::kEmgChannels,
          "a recording of EMG has at most " + std::to_string(kMaximumChannels) +
              " channels, this one " + std::to_string(file.signals.labels.size()),
          {file_name, 0, 0, {}});
  return file;
}

}  // namespace gaitmill
