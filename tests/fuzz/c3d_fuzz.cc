#include "core/io/c3d_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(c3d) {
  const C3dFile file = readC3d(input, "fuzz.c3d");
  const MarkerTrajectories& markers = file.markers;
  requirePromise(markers.positions.rows() == markers.frameCount() &&
                     markers.positions.cols() == 3 * markers.markerCount(),
                 "every marker has all frames");
  for (int frame = 1; frame < markers.frameCount(); ++frame) {
    const auto k = static_cast<std::size_t>(frame);
    requirePromise(markers.time[k] > markers.time[k - 1], "time increases");
  }
  const auto samples = static_cast<Eigen::Index>(file.ground_reaction.time.size());
  for (const ExternalForce& force : file.ground_reaction.forces) {
    requirePromise(force.force.cols() == samples, "a force has all samples");
    requirePromise(force.force.allFinite() && force.torque.allFinite() && force.point.allFinite(),
                   "no force is missing");
  }
  requirePromise(file.analog.values.rows() == file.analog.rowCount() &&
                     file.analog.units.size() == file.analog.labels.size(),
                 "every channel has all samples and a unit");
  for (const C3dEvent& event : file.events) {
    requirePromise(event.time == event.time, "events have times");
  }
}

}  // namespace gaitmill
