#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/io/c3d_layout.h"

namespace gaitmill {

// The frames of a C3D file as numbers. Internal to core/io.

/// Factors of analog values: value = (raw - offset) scale; one of each per channel.
struct C3dAnalogScale {
  enum class Integers { kSigned, kUnsigned };
  Integers integers = Integers::kSigned;  ///< of raw values in integer files
  std::vector<double> offset;
  std::vector<double> scale;  ///< ANALOG:SCALE times ANALOG:GEN_SCALE
};

struct C3dSamples {
  RowMatrix points;  ///< (frames x 3 columns.size()) [length unit of the file], missing = NaN
  RowMatrix analog;  ///< (frames subframes x channels)
  /// Frames in which a point is exactly 0, 0, 0 although its residual is not -1; one per column.
  std::vector<int> zero_counts;
};

/// Reads the points numbered in `columns` (from 0) and all analog channels.
/// A point is missing where its fourth word is negative, where a coordinate is not finite, and
/// where it is exactly 0, 0, 0.
C3dSamples readC3dSamples(const C3dBytes& file,
                          const C3dLayout& layout,
                          const std::vector<int>& columns,
                          const C3dAnalogScale& scale);

}  // namespace gaitmill
