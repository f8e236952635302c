#include <algorithm>
#include <functional>

#include "core/io/table_writer.h"
#include "core/io/trc_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

void checkTrc(std::string_view input, const TrcOptions& options) {
  const MarkerTrajectories markers = readTrc(input, "fuzz.trc", options).markers;
  requirePromise(markers.frameCount() > 0 && markers.markerCount() > 0, "there is something in it");
  requirePromise(markers.positions.rows() == markers.frameCount() &&
                     markers.positions.cols() == Eigen::Index{3} * markers.markerCount(),
                 "positions fit names and times");
  requirePromise(
      std::adjacent_find(markers.time.begin(), markers.time.end(), std::greater_equal<>()) ==
          markers.time.end(),
      "times increase");
  requirePromise(!markers.positions.array().isInf().any(), "a position is a number or missing");
}

}  // namespace

GAITMILL_FUZZ_TARGET(trc) {
  tryParse([&] { checkTrc(input, {}); });
  TrcOptions other;
  other.times = TrcOptions::Times::kExact;
  other.zeros = TrcOptions::Zeros::kMeasured;
  other.prefixes = TrcOptions::Prefixes::kStrip;
  tryParse([&] { checkTrc(input, other); });
}

}  // namespace gaitmill
