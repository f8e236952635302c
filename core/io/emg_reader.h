#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/time_series.h"
#include "core/io/c3d_reader.h"

namespace gaitmill {

/// An EMG recording as its file has it: raw or processed already, which nobody has decided yet.
struct EmgFile {
  TimeSeries signals;  ///< units as stated, "V" for raw counts; "" = not stated
  std::string format;  ///< "anc", "c3d" or "table"
  std::vector<std::string> force_channels;  ///< of force plates, left out
  std::vector<std::string> warnings;
};

/// The analog channels of a C3D file that may be EMG: those of no plate whose unit is V or not
/// stated. May have no channel.
EmgFile takeEmg(C3dFile&& file);

/// Reads EMG out of an analog file of raw counts (readAnc), a C3D file (takeEmg), or a table over
/// time (readTable: STO, MOT, CSV, and text separated by tabs or blanks). Channels of force plates
/// that were recorded beside it (F1X, M2Z, Fz1) are left out.
/// @throws Error of both readers; kEmgChannels if no channel is left, or more
/// than 256
EmgFile readEmg(std::string_view bytes, const std::string& file_name);

}  // namespace gaitmill
