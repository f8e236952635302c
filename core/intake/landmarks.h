#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/where.h"
#include "core/data/model_spec.h"

namespace gaitmill {

// The places on a body that laboratories put markers on, by one name each, whatever the laboratory
// calls them. Names are those of the markers of Rajagopal2016 where it has one (RASI, RLFC, ...);
// the others follow its manner: side, then the place.

enum class Side { kMiddle, kRight, kLeft };

enum class LandmarkKind {
  kBony,         ///< a bone felt under the skin: the same place on everybody
  kJointCenter,  ///< computed from other markers or from movement
  kTechnical,    ///< wherever it is seen well: clusters, wands, soft tissue
  kDerived,      ///< computed from other markers: midpoints, projections on the floor
};

/// Where a landmark's generic location comes from.
enum class LocationSource {
  kModel,     ///< a marker of Rajagopal2016 or of the Hamner 2010 model
  kSetup,     ///< a published marker set of these models (spec/scale.md 6.1, 7.2)
  kMesh,      ///< the bone meshes of the model, plus 1 cm of skin and marker
  kEstimate,  ///< anatomy by eye
};

struct Landmark {
  std::string name;  ///< unique: "RASI", "C7"
  Side side = Side::kMiddle;
  std::string body;                                    ///< of Rajagopal2016: "femur_r"
  Eigen::Vector3d location = Eigen::Vector3d::Zero();  ///< in that body, generic size [m]
  LandmarkKind kind = LandmarkKind::kBony;
  LocationSource source = LocationSource::kModel;
  /// One standard deviation of where people put it, per axis [m]. Bony places 12 mm: between
  /// examiners 13 to 25 mm in space (Della Croce et al. 1999, Med Biol Eng Comput 37:155); hip
  /// centres of regressions 15 mm (Leardini et al. 1999, J Biomech 32:99); technical markers 50 mm.
  double placement_deviation = 0;
  std::string description;  ///< "anterior superior iliac spine, right"
};

/// All landmarks: middle ones once, the others right and left, mirrored exactly in z.
const std::vector<Landmark>& landmarks();

/// @returns nullptr if there is none of that name (case counts)
const Landmark* findLandmark(const std::string& name);

/// @throws Error kMarkerNames with the nearest name unless there is a landmark of that name
void requireLandmark(const std::string& name, const Where& where);

/// The landmark of the other side; of the middle, itself. @returns nullptr for an unknown name
const Landmark* findOpposite(const std::string& name);

/// The name that a model gives to a body of Rajagopal2016; the Delp lineage (gait2392, Hamner 2010)
/// has the same names and frames, some descendants write "femur_R", "thorax" or, where there is one
/// leg, "femur". @returns nullopt if the model has no such body
std::optional<std::string> findModelBody(const std::string& body, const ModelSpec& model);

/// Where a landmark is from the pelvis origin when the generic model stands with every coordinate
/// at 0: X forward, Y up, Z right, arms hanging [m].
Eigen::Vector3d calcStandingPosition(const Landmark& landmark);

}  // namespace gaitmill
