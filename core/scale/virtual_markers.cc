#include "core/scale/virtual_markers.h"

#include <cstddef>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vector3d calcMean(const std::vector<Vector3d>& points, std::size_t first) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = first; i < points.size(); ++i) {
    sum += points[i];
  }
  return sum / static_cast<double>(points.size() - first);
}

Vector3d calcPoint(VirtualMarkerSpec::Rule rule, const std::vector<Vector3d>& sources) {
  if (rule == VirtualMarkerSpec::Rule::kMean) {
    return calcMean(sources, 0);
  }
  const PelvisPoints pelvis{sources[0], sources[1], calcMean(sources, 2)};
  return calcHipCenter(pelvis, rule == VirtualMarkerSpec::Rule::kRightHipCenter)
      .value_or(Vector3d::Constant(kNaN));
}

/// Columns of the sources; empty if one is not there.
std::vector<int> findSources(const VirtualMarkerSpec& point, const MarkerTrajectories& trial) {
  const bool is_hip = point.rule != VirtualMarkerSpec::Rule::kMean;
  require(point.sources.size() >= (is_hip ? 3U : 1U),
          ErrorCode::kInputMarkers,
          "the virtual marker '" + point.name + "' has too few sources",
          atMarker(point.name));
  std::vector<int> columns;
  for (const std::string& source : point.sources) {
    const std::optional<int> column = trial.findMarker(source);
    if (!column) {
      return {};
    }
    columns.push_back(*column);
  }
  return columns;
}

}  // namespace

std::optional<Vector3d> calcHipCenter(const PelvisPoints& pelvis, bool right) {
  const Vector3d middle = 0.5 * (pelvis.right_asis + pelvis.left_asis);
  const Vector3d across = pelvis.right_asis - pelvis.left_asis;
  const Vector3d back = pelvis.mid_psis - middle;
  const Vector3d normal = across.cross(-back);  // z x x = y
  const double width = across.norm();
  const double depth = back.norm();
  if (!(normal.norm() > 1e-9 * width * depth)) {
    return std::nullopt;
  }
  const Vector3d z = across / width;
  const Vector3d y = normal.normalized();
  const Vector3d x = y.cross(z);
  const double side = right ? 1.0 : -1.0;
  return middle + (-0.24 * depth - 0.0099) * x + (-0.30 * width - 0.0109) * y +
         side * (0.33 * width + 0.0073) * z;
}

void addVirtualMarkers(const std::vector<VirtualMarkerSpec>& points, MarkerTrajectories& trial) {
  for (const VirtualMarkerSpec& point : points) {
    const std::vector<int> columns = findSources(point, trial);
    if (columns.empty() || trial.findMarker(point.name)) {
      continue;
    }
    trial.positions.conservativeResize(Eigen::NoChange, trial.positions.cols() + 3);
    std::vector<Vector3d> sources(columns.size());
    for (int frame = 0; frame < trial.frameCount(); ++frame) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        sources[i] = trial.position(frame, columns[i]);
      }
      trial.positions.row(frame).tail<3>() = calcPoint(point.rule, sources).transpose();
    }
    trial.names.push_back(point.name);
  }
}

}  // namespace gaitmill
