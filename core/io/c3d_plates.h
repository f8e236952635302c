#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/ground_reaction.h"
#include "core/io/c3d_layout.h"
#include "core/io/c3d_parameters.h"
#include "core/io/c3d_samples.h"

namespace gaitmill {

/// A force plate as the file describes it.
struct C3dPlate {
  std::string name;  ///< "plate_1" in the order of the file, also of its force
  int type = 0;      ///< as the file numbers types; 1 to 4 are read
  /// (3 x 4) [m] laboratory axes; corner 1 lies at (+x, +y) of the plate's own axes, then (-x, +y),
  /// (-x, -y), (+x, -y)
  Eigen::Matrix<double, 3, 4> corners = Eigen::Matrix<double, 3, 4>::Zero();
  std::string refusal;  ///< why its forces cannot be had; empty if they were read
};

// What follows is internal to core/io.

/// What the plates need of the file beside parameters and samples.
struct C3dPlateInput {
  double metres_per_unit = 1e-3;           ///< of the file's points
  std::vector<std::string> channel_units;  ///< as stated, one per analog channel, "" = not stated
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< laboratory axis; zero = not stated
  bool subtract_baseline = false;  ///< by FORCE_PLATFORM:ZERO, see C3dOptions::Baseline
  int subframe_count = 1;          ///< analog rows per frame
};

struct C3dPlates {
  std::vector<C3dPlate> plates;
  std::vector<ExternalForce> forces;  ///< of plates without refusal
  std::vector<bool> plate_channels;   ///< one per analog channel: belongs to some plate
};

/// Wrenches of the plates from their channels (spec/formats.md 4.6): force on the subject, centre
/// of pressure on the plate's surface and the free moment about its normal, in laboratory axes.
/// Where the force along the normal is below 1 mN, the point is the plate's centre.
/// A plate that cannot be read is refused with a warning, the others are not affected.
C3dPlates readC3dPlates(const C3dParameters& parameters,
                        RowMatrix& analog,
                        const C3dPlateInput& input,
                        std::vector<std::string>& warnings);

}  // namespace gaitmill
