#include "core/scale/strength.h"

#include <cmath>
#include <cstddef>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {

namespace {

/// Volume of the leg muscles = slope m h + constant [cm^3], m in kg, h in m.
struct VolumeLaw {
  double slope;
  double constant;
  double calc(double mass, double height) const { return slope * mass * height + constant; }
};

constexpr VolumeLaw kPaper{47.0, 1285.0};     // Rajagopal et al. 2016, equation 2
constexpr VolumeLaw kScripts{47.05, 1289.6};  // scripts distributed with the paper

void requireSize(const BodySize& size) {
  require(std::isfinite(size.mass) && size.mass > 0,
          ErrorCode::kInputValue,
          "mass must be a positive number of kilograms",
          {{}, 0, 0, "mass"});
  require(std::isfinite(size.height) && size.height > 0,
          ErrorCode::kInputValue,
          "height must be a positive number of metres",
          {{}, 0, 0, "height"});
}

}  // namespace

double calcVolumeRatio(StrengthLaw law, const BodySize& subject, const BodySize& generic) {
  if (law == StrengthLaw::kNone) {
    return 1.0;
  }
  requireSize(subject);
  requireSize(generic);
  if (law == StrengthLaw::kAsPublished) {
    return kScripts.calc(subject.mass, subject.height) /
           kScripts.calc(subject.mass, generic.height);
  }
  return kPaper.calc(subject.mass, subject.height) / kPaper.calc(generic.mass, generic.height);
}

void scaleStrength(const ModelSpec& generic,
                   StrengthLaw law,
                   const BodySize& subject,
                   ModelSpec& model,
                   const BodySize& generic_size) {
  const double volume_ratio = calcVolumeRatio(law, subject, generic_size);
  for (MuscleSpec& muscle : model.muscles) {
    double factor = volume_ratio;
    if (law == StrengthLaw::kAsIntended) {
      const int index = generic.findMuscle(muscle.name);
      require(index >= 0,
              ErrorCode::kModelReference,
              "the generic model has no muscle of this name to compare fiber lengths with",
              atMuscle(muscle.name));
      factor /= muscle.optimal_fiber_length /
                generic.muscles[static_cast<std::size_t>(index)].optimal_fiber_length;
    }
    muscle.max_isometric_force *= factor;
  }
}

}  // namespace gaitmill
