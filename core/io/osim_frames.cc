#include "core/io/osim_frames.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace gaitmill {

namespace {

// Offset frames on offset frames: real models nest once or twice; a ring would never end.
constexpr int kMaximumFrameDepth = 16;

Eigen::Vector3d calcAngles(const Eigen::Matrix3d& R) {
  const double b = std::asin(std::clamp(R(0, 2), -1.0, 1.0));
  return {std::atan2(-R(1, 2), R(2, 2)), b, std::atan2(-R(0, 1), R(0, 0))};
}

}  // namespace

FrameSpec composeFrames(const FrameSpec& base,
                        const Eigen::Vector3d& translation,
                        const Eigen::Vector3d& orientation) {
  if (base.translation.isZero(0) && base.orientation.isZero(0)) {
    return {base.body, translation, orientation};
  }
  if (translation.isZero(0) && orientation.isZero(0)) {
    return base;
  }
  const Eigen::Matrix3d R = makeRotation(base.orientation);
  return {base.body, base.translation + R * translation, calcAngles(R * makeRotation(orientation))};
}

std::string lastComponent(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

Eigen::Matrix3d makeRotation(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

void OsimFrames::addBody(const OsimElement& body, const std::string& name) {
  if (name == "ground" || !bodies_.insert(name).second) {
    body.fail(ErrorCode::kModelDuplicateName, "there is already a body '" + name + "'");
  }
}

void OsimFrames::addOffsetFrames(const std::string& owner, const std::vector<OsimElement>& frames) {
  for (const OsimElement& frame : frames) {
    const std::string name = frame.requireName();
    if (!offset_frames_.emplace(Key{owner, name}, frame).second) {
      frame.fail(ErrorCode::kModelDuplicateName, "its owner has another frame of this name");
    }
  }
}

FrameSpec OsimFrames::resolve(const OsimElement& socket, const std::string& owner) const {
  return resolve(socket, owner, 0);
}

FrameSpec OsimFrames::resolve(const OsimElement& socket,
                              const std::string& owner,
                              int depth) const {
  const std::string path = socket.ownText();
  const std::string name = path == ".." ? owner : lastComponent(path);
  if (const Key* key = findKey(path, owner)) {
    if (depth > kMaximumFrameDepth) {
      socket.fail(ErrorCode::kModelTopology, "offset frames refer to each other in a ring");
    }
    return makeFrame(*key, depth);
  }
  if (name != "ground" && bodies_.count(name) == 0) {
    failUnknown(socket);
  }
  return {name, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

// The same frame name exists in several joints with different offsets: a path names the owner, a
// bare name means one of the asking component's own frames.
const OsimFrames::Key* OsimFrames::findKey(const std::string& path,
                                           const std::string& owner) const {
  const std::string name = lastComponent(path);
  const std::string above =
      path.size() > name.size() ? lastComponent(path.substr(0, path.size() - name.size() - 1)) : "";
  const bool absolute = !path.empty() && path.front() == '/';
  auto found = offset_frames_.find({above, name});
  if (found == offset_frames_.end() && !absolute) {
    found = offset_frames_.find({owner, name});
  }
  return found == offset_frames_.end() ? nullptr : &found->first;
}

FrameSpec OsimFrames::makeFrame(const Key& key, int depth) const {
  const OsimElement& frame = offset_frames_.at(key);
  const OsimElement parent = frame.socket("parent");
  if (!parent) {
    frame.fail(ErrorCode::kModelElement, frame.describe() + " has no <socket_parent>");
  }
  return composeFrames(resolve(parent, key.first, depth + 1),
                       frame.vector3("translation", Eigen::Vector3d::Zero()),
                       frame.vector3("orientation", Eigen::Vector3d::Zero()));
}

PathPointSpec OsimFrames::resolvePoint(const OsimElement& socket,
                                       const Eigen::Vector3d& location) const {
  const FrameSpec frame = resolve(socket, "");
  if (frame.translation.isZero(0) && frame.orientation.isZero(0)) {
    return {frame.body, location};
  }
  return {frame.body, frame.translation + makeRotation(frame.orientation) * location};
}

std::string OsimFrames::resolveBody(const OsimElement& reference) const {
  std::string name = lastComponent(reference.ownText());
  if (name != "ground" && bodies_.count(name) == 0) {
    failUnknown(reference);
  }
  return name;
}

void OsimFrames::failUnknown(const OsimElement& socket) const {
  const std::string name = lastComponent(socket.ownText());
  const std::string nearest = findNearestName(name, {bodies_.begin(), bodies_.end()});
  socket.fail(ErrorCode::kModelReference,
              "there is no body or frame '" + socket.ownText() + "'" +
                  (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

}  // namespace gaitmill
