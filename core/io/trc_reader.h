#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/marker_trajectories.h"

namespace gaitmill {

struct TrcOptions {
  /// What to do with times that were rounded when printed (0.017, 0.033, ... at 60 Hz).
  enum class Times {
    kRegular,  ///< t0 + k / DataRate where all printed times are that to half their last decimal
    kExact,    ///< as printed, which is what OpenSim uses
  };
  Times times = Times::kRegular;
  /// What an exact 0, 0, 0 means. Some laboratories write it for a marker that was not seen.
  enum class Zeros { kMissing, kMeasured };
  Zeros zeros = Zeros::kMissing;
  /// "Justin:RASI" -> "RASI"
  enum class Prefixes { kKeep, kStrip };
  Prefixes prefixes = Prefixes::kKeep;
};

struct TrcFile {
  MarkerTrajectories markers;  ///< [m], missing = NaN
  std::string units;           ///< that the file has lengths in: "m", "cm" or "mm"
  std::vector<std::string> warnings;
};

/// Reads marker trajectories with all irregularities of spec/formats.md 1.3: trailing tabs, counts
/// that do not match the rows, no blank line before the data, blank-padded values, missing markers
/// as empty cells, NaN or zeros, a cut last row, repeated or unlabelled markers, times that do not
/// increase (rebuilt from DataRate). Each of these is a warning; names stand on line 4 only.
/// @throws Error kTrcHeader, kTrcUnits, kTrcMarkerNames, kTrcColumnCount, kTrcNumber,
/// kTrcTimeOrder (times do not increase and there is no rate), kTrcNoRows, kFileEmpty,
/// kFileNotTheData; with line and column. Faults of several rows are reported together.
TrcFile readTrc(std::string_view bytes,
                const std::string& file_name,
                const TrcOptions& options = {});

}  // namespace gaitmill
