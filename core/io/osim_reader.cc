#include "core/io/osim_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include <Eigen/Eigenvalues>

#include "core/io/number_text.h"
#include "core/io/osim_element.h"
#include "core/io/osim_forces.h"
#include "core/io/osim_frames.h"
#include "core/io/osim_geometry.h"
#include "core/io/osim_joints.h"
#include "core/io/osim_passive_forces.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

constexpr std::size_t kMaximumWraps = 2000;   // the full-body model has 40
constexpr std::size_t kMaximumMeshes = 2000;  // the full-body model has 81

bool isContactForce(const OsimElement& force) {
  constexpr std::array<std::string_view, 3> kTypes = {
      "SmoothSphereHalfSpaceForce", "HuntCrossleyForce", "ElasticFoundationForce"};
  return std::find(kTypes.begin(), kTypes.end(), force.type()) != kTypes.end();
}

/// What cannot be simulated.
struct Finding {
  std::string type;  ///< of the element
  std::string message;
  Where where;
};

/// "line 12: WrapTorus 'hole': reason"
std::string formatFinding(const Finding& finding) {
  const std::string& element = finding.where.field;
  std::string_view reason = finding.message;
  if (reason.substr(0, element.size()) == element) {
    reason.remove_prefix(element.size());
    reason.remove_prefix(std::min(reason.find_first_not_of(": "), reason.size()));
  }
  return "\nline " + std::to_string(finding.where.line) + ": " + element + ": " +
         std::string(reason);
}

/// Reads one document, in the order in which references point: bodies, joints, then what is
/// attached to them.
class ModelReader {
 public:
  ModelReader(const OsimElement& model, std::vector<std::string>* warnings)
      : model_(model), warnings_(warnings) {}

  ModelSpec read() {
    try {
      readHeader();
      readBodies();
      readJoints();
      readConstraints();
      foldCoupledJoints();
      readMarkers();
      readForces();
    } catch (const Error&) {
      if (findings_.empty()) {
        throw;
      }
    }
    if (!findings_.empty()) {
      failUnsupported();
    }
    readGroups();
    return std::move(spec_);
  }

 private:
  void readHeader();
  void readBodies();
  void readBody(const OsimElement& element);
  void readMeshes(const OsimElement& element, std::size_t body);
  void addMesh(const OsimElement& owner, BodySpec& body, MeshSpec mesh);
  void readJoints();
  void readConstraints();
  void readConstraint(const OsimElement& element, std::set<std::string>& names);
  void foldCoupledJoints();
  void readMarkers();
  void readForces();
  void readForce(const OsimElement& force);
  void readGroups();
  void addWraps(const OsimElement& owner, std::vector<WrapObjectSpec>& wraps);
  void requireNew(std::set<std::string>& names, const OsimElement& element);
  template <class Read>
  void collect(const OsimElement& element, Read read);
  [[noreturn]] void failUnsupported() const;
  void warn(const OsimElement& element, const std::string& sentence);

  OsimElement model_;
  std::vector<std::string>* warnings_;
  ModelSpec spec_;
  OsimFrames frames_;
  std::vector<OsimElement> body_elements_;
  std::vector<std::string> wrap_objects_;
  std::size_t mesh_count_ = 0;
  std::set<std::string> force_names_;
  std::vector<Finding> findings_;
};

/// Reads one element. What cannot be simulated is noted, so that all of it can be told at once;
/// what else is wrong once something was noted may be its consequence, and is left.
template <class Read>
void ModelReader::collect(const OsimElement& element, Read read) {
  constexpr std::size_t kMaximumFindings = 500;
  try {
    read();
  } catch (const Error& error) {
    const bool is_finding = error.code() == ErrorCode::kModelUnsupported;
    if (!is_finding && findings_.empty()) {
      throw;
    }
    if (is_finding && findings_.size() < kMaximumFindings) {
      findings_.push_back({std::string(element.type()), error.message(), error.where()});
    }
  }
}

/// One line per finding, those of a type that was not named yet first: an error's text is bounded,
/// and what is left out must not be the only one of its kind.
void ModelReader::failUnsupported() const {
  constexpr std::size_t kRoomForLines = Error::kMaximumText - 200;
  std::set<std::string> types;
  std::vector<const Finding*> order;
  for (const Finding& finding : findings_) {
    if (types.insert(finding.type).second) {
      order.push_back(&finding);
    }
  }
  for (const Finding& finding : findings_) {
    if (std::find(order.begin(), order.end(), &finding) == order.end()) {
      order.push_back(&finding);
    }
  }
  std::string lines;
  std::size_t told = 0;
  for (const Finding* finding : order) {
    const std::string line = formatFinding(*finding);
    if (lines.size() + line.size() > kRoomForLines && told > 0) {
      break;
    }
    lines += line;
    ++told;
  }
  const std::string rest =
      told < order.size() ? "\nand " + std::to_string(order.size() - told) + " more of these types"
                          : "";
  throw Error(
      ErrorCode::kModelUnsupported,
      std::to_string(findings_.size()) +
          (findings_.size() == 1 ? " part of the model cannot" : " parts of the model cannot") +
          " be simulated and would change the results if left out:" + lines + rest,
      findings_.front().where);
}

void ModelReader::warn(const OsimElement& element, const std::string& sentence) {
  // To find a line takes a walk through the document.
  constexpr std::size_t kMaximumWarnings = 100;
  if (warnings_ != nullptr && warnings_->size() < kMaximumWarnings) {
    warnings_->push_back("line " + std::to_string(element.where().line) + ": " +
                         element.describe() + " " + sentence);
  }
}

void ModelReader::requireNew(std::set<std::string>& names, const OsimElement& element) {
  const std::string name = element.requireName();
  if (!names.insert(name).second) {
    element.fail(
        ErrorCode::kModelDuplicateName,
        "there is already a " + std::string(element.type()) + " or like object '" + name + "'");
  }
}

void ModelReader::readHeader() {
  spec_.name = model_.nameOr("");
  spec_.document_version = model_.document().version();
  spec_.credits = model_.text("credits");
  spec_.gravity = model_.vector3("gravity", Vector3d(0, -9.80665, 0));
}

std::array<double, 6> readInertia(const OsimElement& body) {
  std::array<double, 6> inertia = {};
  if (const OsimElement stated = body.property("inertia")) {
    const std::vector<double> numbers = stated.ownNumbers(6);
    std::copy(numbers.begin(), numbers.end(), inertia.begin());
  } else {
    constexpr std::array<const char*, 6> kTags = {
        "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xy", "inertia_xz", "inertia_yz"};
    const bool any =
        std::any_of(kTags.begin(), kTags.end(), [&](const char* tag) { return body.has(tag); });
    for (std::size_t i = 0; any && i < kTags.size(); ++i) {
      inertia[i] = body.number(kTags[i], i < 3 ? 1.0 : 0.0);
    }
  }
  if (inertia[0] < 0 || inertia[1] < 0 || inertia[2] < 0) {
    body.fail(ErrorCode::kModelValue, body.describe() + " has a negative moment of inertia");
  }
  return inertia;
}

/// Raises the middle principal moment where the largest exceeds the sum of the other two, which no
/// body can have: to the difference, that of a flat body. @returns what was done, empty if nothing
std::string repairInertia(std::array<double, 6>& I) {
  Eigen::Matrix3d tensor;
  tensor << I[0], I[3], I[4], I[3], I[1], I[5], I[4], I[5], I[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tensor);
  Vector3d moments = principal.eigenvalues();  // ascending
  constexpr double kRounding = 1e-9;
  if (moments[0] < 0 || moments[0] + moments[1] >= (1 - kRounding) * moments[2]) {
    return "";
  }
  const double stated = moments[1];
  moments[1] = moments[2] - moments[0];
  const Eigen::Matrix3d& axes = principal.eigenvectors();
  const Eigen::Matrix3d repaired = axes * moments.asDiagonal() * axes.transpose();
  I = {repaired(0, 0),
       repaired(1, 1),
       repaired(2, 2),
       repaired(0, 1),
       repaired(0, 2),
       repaired(1, 2)};
  return "has an inertia that no body can have; its moment of " + formatNumber(stated) +
         " kg m^2 was raised to " + formatNumber(moments[1]) +
         ", the largest moment less the smallest";
}

void ModelReader::addWraps(const OsimElement& owner, std::vector<WrapObjectSpec>& wraps) {
  for (const OsimElement& element : owner.objectsOf("WrapObjectSet")) {
    WrapObjectSpec wrap;
    wrap.name = element.requireName();
    collect(element, [&] { wrap = readWrapObject(element); });
    if (std::find(wrap_objects_.begin(), wrap_objects_.end(), wrap.name) != wrap_objects_.end()) {
      owner.property("WrapObjectSet")
          .fail(ErrorCode::kModelDuplicateName,
                "there is already a wrap object '" + wrap.name + "'");
    }
    wrap_objects_.push_back(wrap.name);
    if (wrap_objects_.size() > kMaximumWraps) {
      owner.fail(ErrorCode::kModelUnsupported,
                 "the model has more than " + std::to_string(kMaximumWraps) + " wrap objects");
    }
    wraps.push_back(wrap);
  }
}

void ModelReader::readBody(const OsimElement& element) {
  const std::string name = element.requireName();
  if (name == "ground") {  // documents below 30501 list ground among the bodies
    addWraps(element, spec_.ground_wrap_objects);
    return;
  }
  frames_.addBody(element, name);
  BodySpec body;
  body.name = name;
  body.mass = element.requireNumber("mass");
  if (!(body.mass >= 0) || !std::isfinite(body.mass)) {
    element.property("mass").fail(ErrorCode::kModelValue, "the mass of a body cannot be negative");
  }
  body.mass_center = element.vector3("mass_center", Vector3d::Zero());
  body.inertia = readInertia(element);
  const std::string repair = repairInertia(body.inertia);
  if (!repair.empty()) {
    warn(element, repair);
  }
  addWraps(element, body.wrap_objects);
  frames_.addOffsetFrames(name, element.property("components").children());
  body_elements_.push_back(element);
  spec_.bodies.push_back(std::move(body));
}

void ModelReader::addMesh(const OsimElement& owner, BodySpec& body, MeshSpec mesh) {
  if (++mesh_count_ > kMaximumMeshes) {
    owner.fail(ErrorCode::kModelUnsupported,
               "the model has more than " + std::to_string(kMaximumMeshes) + " meshes");
  }
  body.meshes.push_back(std::move(mesh));
}

// The offset frames that a body holds may carry meshes, too; such a frame may sit on another body.
void ModelReader::readMeshes(const OsimElement& element, std::size_t body) {
  for (MeshSpec& mesh : gaitmill::readMeshes(element)) {
    addMesh(element, spec_.bodies[body], std::move(mesh));
  }
  const std::string& owner = spec_.bodies[body].name;
  for (const OsimElement& frame : element.property("components").children()) {
    for (MeshSpec& mesh : gaitmill::readMeshes(frame)) {
      const FrameSpec place = composeFrames(
          frames_.resolveOwn(owner, frame.requireName()), mesh.translation, mesh.orientation);
      const int base = spec_.findBody(place.body);
      if (base >= 0) {
        mesh.translation = place.translation;
        mesh.orientation = place.orientation;
        addMesh(frame, spec_.bodies[static_cast<std::size_t>(base)], std::move(mesh));
      }
    }
  }
}

void ModelReader::readBodies() {
  if (const OsimElement ground = model_.property("Ground")) {
    addWraps(ground, spec_.ground_wrap_objects);
  }
  for (const OsimElement& element : model_.objectsOf("BodySet")) {
    collect(element, [&] {
      if (element.type() != "Body") {
        element.fail(ErrorCode::kModelUnsupported, element.describe() + ": is not a rigid body");
      }
      readBody(element);
    });
  }
  if (spec_.bodies.empty()) {
    model_.fail(ErrorCode::kModelElement, "the model has no bodies");
  }
  for (std::size_t body = 0; body < body_elements_.size(); ++body) {
    readMeshes(body_elements_[body], body);
  }
}

void ModelReader::readJoints() {
  const std::vector<OsimJoint> joints = collectJoints(model_);
  std::set<std::string> names;
  for (const OsimJoint& joint : joints) {
    requireNew(names, joint.element);
    frames_.addOffsetFrames(joint.element.requireName(),
                            joint.element.property("frames").children());
  }
  std::set<std::string> coordinates;
  for (const OsimJoint& joint : joints) {
    collect(joint.element, [&] {
      spec_.joints.push_back(readJoint(joint, frames_));
      if (hasAngularSpeeds(joint.element)) {
        warn(joint.element,
             "is moved by the rates of its angles, to which its moments belong; in OpenSim they "
             "belong to components of its angular velocity");
      }
      for (const OsimElement& axis : findIdleAxes(joint.element)) {
        warn(axis, "names a coordinate but no function, and does not move with it");
      }
      for (const CoordinateSpec& coordinate : spec_.joints.back().coordinates) {
        if (!coordinates.insert(coordinate.name).second) {
          joint.element.fail(ErrorCode::kModelDuplicateName,
                             "there is already a coordinate '" + coordinate.name + "'");
        }
      }
    });
  }
  if (findings_.empty()) {
    requireTree(body_elements_, joints, spec_.joints);
  }
}

void ModelReader::readConstraints() {
  std::set<std::string> names;
  for (const OsimElement& element : model_.objectsOf("ConstraintSet")) {
    collect(element, [&] { readConstraint(element, names); });
  }
}

/// The couplers of a joint's coordinates, in their order; empty unless all of them follow one and
/// the same coordinate, some by a curve, and each drives its axes one to one.
std::vector<const CouplerSpec*> findCurvedCouplers(const JointSpec& joint,
                                                   const std::vector<CouplerSpec>& couplers) {
  std::vector<const CouplerSpec*> found;
  bool curved = false;
  for (const CoordinateSpec& coordinate : joint.coordinates) {
    const auto coupler =
        std::find_if(couplers.begin(), couplers.end(), [&](const CouplerSpec& candidate) {
          return candidate.enforced && candidate.dependent == coordinate.name;
        });
    if (coupler == couplers.end() ||
        (!found.empty() && coupler->independent != found.front()->independent)) {
      return {};
    }
    curved = curved || (coupler->function.kind != FunctionSpec::Kind::kLinear &&
                        coupler->function.kind != FunctionSpec::Kind::kConstant);
    found.push_back(&*coupler);
  }
  const bool direct =
      std::all_of(joint.axes.begin(), joint.axes.end(), [](const TransformAxisSpec& axis) {
        return axis.coordinate.empty() ||
               (axis.function.kind == FunctionSpec::Kind::kLinear && axis.function.y.at(1) == 0.0);
      });
  return curved && direct && joint.kind == JointSpec::Kind::kCustom
             ? found
             : std::vector<const CouplerSpec*>();
}

/// A joint all of whose coordinates follow another one by curves (the patella of the Arnold leg)
/// moves as one coordinate that equals the other, with the curves on its axes: the same motion, by
/// a coupler that is linear, as in Rajagopal2016.
void ModelReader::foldCoupledJoints() {
  for (JointSpec& joint : spec_.joints) {
    const std::vector<const CouplerSpec*> couplers = findCurvedCouplers(joint, spec_.couplers);
    const CoordinateSpec* driver =
        couplers.empty() ? nullptr : spec_.findCoordinate(couplers.front()->independent);
    if (driver == nullptr) {
      continue;
    }
    CoordinateSpec kept = *driver;
    kept.name = joint.coordinates.front().name;
    kept.clamped = false;
    kept.locked = false;
    CouplerSpec equal = *couplers.front();
    equal.function = {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1};
    equal.scale = 1;
    for (TransformAxisSpec& axis : joint.axes) {
      for (const CouplerSpec* coupler : couplers) {
        if (coupler->dependent == axis.coordinate) {
          const double slope = axis.function.scale * axis.function.y.at(0);
          axis.function = coupler->function;
          axis.function.scale *= coupler->scale * slope;
          axis.coordinate = kept.name;
          break;
        }
      }
    }
    std::vector<CouplerSpec> others;
    for (const CouplerSpec& coupler : spec_.couplers) {
      const bool folded = std::any_of(
          couplers.begin(), couplers.end(), [&](const CouplerSpec* c) { return c == &coupler; });
      if (!folded) {
        others.push_back(coupler);
      }
    }
    others.push_back(equal);
    spec_.couplers = std::move(others);
    joint.coordinates = {kept};
    warn(model_,
         "moves joint '" + joint.name + "' by the one coordinate '" + kept.name + "', equal to '" +
             driver->name + "', with the curves of its couplers on its axes");
  }
}

void ModelReader::readConstraint(const OsimElement& element, std::set<std::string>& names) {
  if (element.type() == "CoordinateCouplerConstraint") {
    requireNew(names, element);
    spec_.couplers.push_back(readCoupler(element, spec_.joints));
    return;
  }
  const bool enforced = element.has("isEnforced") ? element.boolean("isEnforced", true)
                                                  : !element.boolean("isDisabled", false);
  if (enforced) {
    element.fail(ErrorCode::kModelUnsupported,
                 element.describe() +
                     ": of the constraints only coordinate couplers can be simulated here; without "
                     "it the bodies would move otherwise");
  }
  warn(element, "is not enforced and was left out");
}

MarkerSpec readMarker(const OsimElement& element, const OsimFrames& frames) {
  const OsimElement frame = element.socket("parent_frame", {"body"});
  if (!frame) {
    element.fail(ErrorCode::kModelElement, element.describe() + " names no parent frame");
  }
  const PathPointSpec point =
      frames.resolvePoint(frame, element.vector3("location", Vector3d::Zero()));
  return {element.requireName(), point.body, point.location, element.boolean("fixed", false)};
}

void ModelReader::readMarkers() {
  std::set<std::string> names;
  for (const OsimElement& element : model_.objectsOf("MarkerSet")) {
    requireNew(names, element);
    collect(element, [&] { spec_.markers.push_back(readMarker(element, frames_)); });
  }
}

void ModelReader::readForce(const OsimElement& force) {
  if (!isApplied(force)) {
    warn(force, "is switched off in the document and was left out");
  } else if (isMuscle(force)) {
    requireNew(force_names_, force);
    spec_.muscles.push_back(readMuscle(force, frames_, spec_.joints, wrap_objects_));
  } else if (isActuator(force)) {
    requireNew(force_names_, force);
    spec_.actuators.push_back(readActuator(force, frames_, spec_.joints));
  } else if (isPassiveForce(force)) {
    requireNew(force_names_, force);
    spec_.passive_forces.push_back(readPassiveForce(force, frames_, spec_.joints));
  } else if (isContactForce(force)) {
    warn(force, "was left out: the measured ground reaction takes its place");
  } else {
    force.fail(ErrorCode::kModelUnsupported,
               force.describe() +
                   ": forces of this type cannot be simulated here, and without it the muscles "
                   "would do its work");
  }
}

void ModelReader::readForces() {
  for (const OsimElement& force : model_.objectsOf("ForceSet")) {
    collect(force, [&] { readForce(force); });
  }
}

void ModelReader::readGroups() {
  for (const OsimElement& group : model_.property("ForceSet").property("groups").children()) {
    MuscleGroupSpec spec{group.requireName(), group.words("members")};
    for (const std::string& member : spec.members) {
      if (force_names_.count(member) == 0) {
        group.property("members").fail(ErrorCode::kModelReference,
                                       "there is no force '" + member + "'");
      }
    }
    spec_.muscle_groups.push_back(std::move(spec));
  }
}

}  // namespace

ModelSpec readOsim(std::string_view bytes,
                   const std::string& file_name,
                   std::vector<std::string>* warnings) {
  OsimDocument document(bytes, file_name);
  const OsimElement model = document.root("Model");
  document.readPrototypes(model);
  return ModelReader(model, warnings).read();
}

std::vector<MarkerSpec> readMarkerSet(std::string_view bytes,
                                      const std::string& file_name,
                                      const ModelSpec& spec) {
  OsimDocument document(bytes, file_name);
  const OsimElement set = document.root("MarkerSet");
  document.readPrototypes(set);
  OsimFrames frames;
  for (const BodySpec& body : spec.bodies) {
    frames.addBody(set, body.name);
  }
  std::vector<MarkerSpec> markers;
  std::set<std::string> names;
  for (const OsimElement& element : set.property("objects").children()) {
    markers.push_back(readMarker(element, frames));
    if (!names.insert(markers.back().name).second) {
      element.fail(ErrorCode::kModelDuplicateName,
                   "there is already a marker '" + markers.back().name + "'");
    }
  }
  return markers;
}

}  // namespace gaitmill
