#include "core/render/subject.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/osim_reader.h"

namespace gaitmill {

namespace {

constexpr double kArcStep = 8 * kRadiansPerDegree;

std::vector<BodyMesh> makeBones(const ModelSpec& spec, const std::string& geometry_folder) {
  if (geometry_folder.empty()) return makeStylizedBones(spec);
  std::vector<std::string> warnings;  // the caller of a picture has no use for them
  return readBones(spec, geometry_folder, warnings);
}

BodyIndex findRoot(const Model& model) {
  for (const JointSpec& joint : model.spec().joints) {
    if (joint.parent.body == "ground") return model.getBody(joint.child.body);
  }
  return kGround;
}

}  // namespace

Subject::Subject(const std::string& model_osim, const std::string& geometry_folder)
    : model_(readOsim(model_osim, "model.osim")),
      free_(model_),
      state_(model_),
      paths_(model_),
      bones_(makeBones(model_.spec(), geometry_folder)),
      root_(findRoot(model_)) {}

void Subject::setPose(const TimeSeries& kinematics, double time) {
  Eigen::VectorXd q = model_.defaultPose();
  if (kinematics.rowCount() > 0) {
    const Eigen::VectorXd row = kinematics.interpolate(time);
    const std::vector<std::string>& names = model_.coordinateNames();
    for (std::size_t c = 0; c < names.size(); ++c) {
      const std::optional<int> column = kinematics.findColumn(names[c]);
      if (!column) continue;
      Where where;
      where.coordinate = names[c];
      where.time = time;
      require(std::isfinite(row[*column]),
              ErrorCode::kInputCoordinates,
              "the motion has no value of coordinate '" + names[c] + "' at the time of the picture",
              where);
      q[static_cast<Eigen::Index>(c)] = row[*column];
    }
    free_.conformPose(q);
  }
  state_.setPose(q);
}

Eigen::Vector3d Subject::findFollowPoint() const {
  const Eigen::Vector3d& p = pose(root_).p;
  return {p.x(), 0, p.z()};
}

Eigen::Vector3d Subject::findMarker(int marker) const {
  const MarkerSpec& spec = model_.spec().markers[static_cast<std::size_t>(marker)];
  return pose(model_.getBody(spec.body)) * spec.location;
}

void Subject::tracePath(MuscleIndex muscle, std::vector<PathVertex>& vertices) {
  paths_.tracePath(state_, muscle, kArcStep, vertices);
}

}  // namespace gaitmill
