#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/data/model_spec.h"
#include "core/io/osim_element.h"

namespace gaitmill {

/// The frames of a document by name: ground, bodies, and the offset frames that joints own. Turns a
/// socket's text into a frame on a body (spec/model.md 1.1). Internal to core/io.
class OsimFrames {
 public:
  void addBody(const OsimElement& body, const std::string& name);
  /// Remembers the PhysicalOffsetFrames of one joint (or of one body) under its name.
  void addOffsetFrames(const std::string& owner, const std::vector<OsimElement>& frames);

  bool hasBody(const std::string& name) const { return bodies_.count(name) > 0; }

  /// Frame that `socket` names, seen from the component `owner` ("" = none), with its offset on its
  /// base body. @throws Error kModelReference
  FrameSpec resolve(const OsimElement& socket, const std::string& owner) const;
  /// The frame that `owner` holds under `name`. @throws Error kModelReference, kModelTopology
  FrameSpec resolveOwn(const std::string& owner, const std::string& name) const {
    return makeFrame({owner, name}, 0);
  }
  /// The same for a point: body and location in it.
  PathPointSpec resolvePoint(const OsimElement& socket, const Eigen::Vector3d& location) const;
  /// Body named by plain name or path. @throws Error kModelReference
  std::string resolveBody(const OsimElement& reference) const;

 private:
  using Key = std::pair<std::string, std::string>;  ///< owner, frame

  FrameSpec resolve(const OsimElement& socket, const std::string& owner, int depth) const;
  FrameSpec makeFrame(const Key& key, int depth) const;
  const Key* findKey(const std::string& path, const std::string& owner) const;
  [[noreturn]] void failUnknown(const OsimElement& socket) const;

  std::set<std::string> bodies_;
  std::map<Key, OsimElement> offset_frames_;
};

/// "/bodyset/calcn_r" -> "calcn_r": the component that a path or plain name means.
std::string lastComponent(const std::string& path);

/// Rotation of body-fixed x-y-z angles: Rx(a) Ry(b) Rz(c).
Eigen::Matrix3d makeRotation(const Eigen::Vector3d& angles);

/// The frame at `translation` and `orientation` (angles as above) in the frame `base`.
FrameSpec composeFrames(const FrameSpec& base,
                        const Eigen::Vector3d& translation,
                        const Eigen::Vector3d& orientation);

}  // namespace gaitmill
