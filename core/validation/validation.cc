#include "core/validation/validation.h"

#include <functional>
#include <utility>

#include "core/base/error.h"
#include "core/validation/curve_figures.h"
#include "core/validation/fiber_length_figure.h"
#include "core/validation/isometric_figure.h"
#include "core/validation/moment_arm_figures.h"
#include "core/validation/muscle_title.h"
#include "core/validation/parameter_figures.h"

namespace gaitmill {

namespace {

/// One figure that a model may have.
struct FigureKind {
  FigureInfo info;
  std::function<bool(const ModelSpec&)> isAvailable;
  std::function<Figure(const ModelSpec&, const ValidationOptions&)> make;
};

constexpr const char* kCurvesPrefix = "muscle_curves_";

bool hasMuscles(const ModelSpec& model) {
  return !model.muscles.empty();
}

FigureKind momentArms(ArmJoint joint, FigureInfo info) {
  return {std::move(info),
          [joint](const ModelSpec& model) { return hasMomentArmFigure(model, joint); },
          [joint](const ModelSpec& model, const ValidationOptions&) {
            return makeMomentArmFigure(model, joint);
          }};
}

const std::vector<FigureKind>& figureKinds() {
  static const std::vector<FigureKind> kinds = {
      momentArms(ArmJoint::kKnee,
                 {"knee_moment_arms",
                  "Moment arms at the knee",
                  "Moment arms of the muscles that cross the knee against its flexion."}),
      momentArms(ArmJoint::kAnkle,
                 {"ankle_moment_arms",
                  "Moment arms at the ankle",
                  "Moment arms of the ankle's large muscles against its angle."}),
      momentArms(ArmJoint::kHip,
                 {"hip_moment_arms",
                  "Moment arms at the hip",
                  "Moment arms of gluteal muscles, psoas and hamstrings against hip angles."}),
      {{"isometric_moments",
        "Maximum isometric and passive joint moments",
        "What the muscles can do about hip, knee and ankle in the poses of a dynamometer."},
       hasIsometricFigure,
       [](const ModelSpec& model, const ValidationOptions&) {
         return makeIsometricFigure(model);
       }},
      {{"force_length_velocity",
        "Force-length-velocity and tendon curves",
        "Normalised curves of fiber and tendon."},
       hasMuscles,
       [](const ModelSpec& model, const ValidationOptions&) {
         return makeForceLengthVelocityFigure(model);
       }},
      {{"fiber_lengths_gait",
        "Fiber lengths over a gait cycle",
        "Normalised fiber lengths of the right leg while walking, muscles at rest."},
       hasFiberLengthFigure,
       [](const ModelSpec& model, const ValidationOptions&) {
         return makeFiberLengthFigure(model);
       }},
      {{"parameters",
        "Muscle parameters",
        "Maximum force, fiber length, slack length and pennation beside the printed values."},
       hasMuscles,
       [](const ModelSpec& model, const ValidationOptions&) {
         return makeParameterFigure(model);
       }},
      {{"parameter_variability",
        "Variability of muscle parameters",
        "Printed spreads of the parameters beside recomputed ones."},
       hasVariabilityFigure,
       [](const ModelSpec& model, const ValidationOptions& options) {
         return makeVariabilityFigure(model, options);
       }},
  };
  return kinds;
}

}  // namespace

std::vector<FigureInfo> listValidationFigures(const ModelSpec& model) {
  std::vector<FigureInfo> infos;
  for (const FigureKind& kind : figureKinds()) {
    if (kind.isAvailable(model)) {
      infos.push_back(kind.info);
    }
  }
  for (const MuscleSpec& muscle : model.muscles) {
    infos.push_back({kCurvesPrefix + muscle.name,
                     "Curves of " + makeSidedTitle(muscle.name),
                     "Force-length, force-velocity and tendon curves of one muscle."});
  }
  return infos;
}

Figure makeValidationFigure(const ModelSpec& model,
                            const std::string& name,
                            const ValidationOptions& options) {
  for (const FigureKind& kind : figureKinds()) {
    if (kind.info.name == name && kind.isAvailable(model)) {
      return kind.make(model, options);
    }
  }
  const std::string prefix = kCurvesPrefix;
  if (name.compare(0, prefix.size(), prefix) == 0) {
    const MuscleIndex muscle(model.findMuscle(name.substr(prefix.size())));
    if (muscle.isValid()) {
      return makeMuscleCurvesFigure(model, muscle);
    }
  }
  std::string known;
  for (const FigureInfo& info : listValidationFigures(model)) {
    if (info.name.compare(0, prefix.size(), prefix) != 0) {
      known += info.name + ", ";
    }
  }
  throw Error(ErrorCode::kFigureNotFound,
              "there is no validation figure '" + name + "' of this model; there are " + known +
                  "and muscle_curves_<muscle>");
}

}  // namespace gaitmill
