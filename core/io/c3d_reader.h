#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/data/time_series.h"
#include "core/io/c3d_plates.h"

namespace gaitmill {

struct C3dOptions {
  /// Whether the mean of the plates' channels over the unloaded frames that FORCE_PLATFORM:ZERO
  /// names is subtracted. OpenSim's reader does not do it, and many files name frames under load.
  enum class Baseline { kKeep, kSubtract };
  Baseline baseline = Baseline::kKeep;
};

/// Something that happened at one instant, as the recording program or a person marked it.
struct C3dEvent {
  std::string label;    ///< "Foot Strike", "Foot Off"
  std::string context;  ///< "Left", "Right", "General"; empty if the file does not say
  double time = 0;      ///< [s] on the axis of the markers
};

/// A C3D file in SI units and the laboratory's own axes (mostly Z up), nothing filtered.
struct C3dFile {
  /// Labelled points [m] without model outputs; missing = NaN. May hold no marker at all. Time runs
  /// from 0 at the first frame of the file, whatever number that frame has. A prefix that all
  /// labels share ("Justin:RASI") is left out of the names.
  MarkerTrajectories markers;
  std::string units;  ///< that the file has lengths in: "m", "cm" or "mm"
  /// One force per readable plate, named "plate_1", ..., its body empty: force on the subject,
  /// centre of pressure on the surface, free moment along the plate's normal. No threshold was
  /// applied: unloaded plates have the forces of their drift and points that mean nothing.
  GroundReaction ground_reaction;
  std::vector<C3dPlate> plates;  ///< all that the file describes, refused ones included
  /// Analog channels that belong to no plate. Units "V" for channels in V, mV or uV, which are
  /// converted; else as the file states them ("" = not stated).
  TimeSeries analog;
  int analog_channel_count = 0;  ///< with those of the plates
  double analog_rate = 0;        ///< [Hz], also of the plates; 0 without analog channels
  std::vector<C3dEvent> events;  ///< in the order of time
  long first_frame = 1;          ///< number of the first frame in the uncut recording, from 1
  std::string up;                ///< laboratory axis that POINT:Y_SCREEN shows up: "+Z"; or empty
  std::vector<std::string> warnings;
};

/// Whether bytes begin as a C3D file does: number of a block, then 0x50.
bool isC3d(std::string_view bytes);

/// Reads a C3D file (spec/formats.md 4): Intel, DEC and MIPS processors, integers and reals, any
/// number of points and channels, any sections missing, counts that do not fit the file. Force
/// plates of types 1 to 4; others are refused one by one with a warning, and what else is in the
/// file is read. Event times count from frame 1 of the recording and are moved to the markers'
/// axis: t - (first_frame - 1) / rate.
/// Memory is bounded by some 40 times the size of the file.
/// @throws Error kC3dHeader, kC3dData, kFileEmpty, kFileNotTheData; the field names the parameter
C3dFile readC3d(std::string_view bytes,
                const std::string& file_name,
                const C3dOptions& options = {});

}  // namespace gaitmill
