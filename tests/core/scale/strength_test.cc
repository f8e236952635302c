#include "core/scale/strength.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

ModelSpec makeModel(double fiber_length) {
  ModelSpec spec;
  MuscleSpec muscle;
  muscle.name = "soleus_r";
  muscle.max_isometric_force = 1000;
  muscle.optimal_fiber_length = fiber_length;
  spec.muscles.push_back(muscle);
  return spec;
}

// Factors printed with the published walking and running results (masses after residual reduction).
TEST(Strength, PublishedVariantGivesThePublishedFactors) {
  const BodySize walker{85.06, 1.83};
  const BodySize runner{73.4292, 1.78};
  EXPECT_NEAR(
      calcVolumeRatio(StrengthLaw::kAsPublished, walker, kGenericBodySize), 1.06429, tol(5e-6));
  EXPECT_NEAR(
      calcVolumeRatio(StrengthLaw::kAsPublished, runner, kGenericBodySize), 1.03859, tol(5e-6));
}

TEST(Strength, IntendedLawDividesByTheFiberLengthRatio) {
  const ModelSpec generic = makeModel(0.05);
  ModelSpec subject = makeModel(0.06);
  scaleStrength(generic, StrengthLaw::kAsIntended, {85, 1.82}, subject);
  const double volume_ratio = (47.0 * 85 * 1.82 + 1285) / (47.0 * 75 * 1.70 + 1285);
  EXPECT_NEAR(
      subject.muscles[0].max_isometric_force, 1000 * volume_ratio / (0.06 / 0.05), tol(1e-9));
}

TEST(Strength, PersonOfGenericSizeKeepsTheGenericStrength) {
  const ModelSpec generic = makeModel(0.05);
  ModelSpec subject = makeModel(0.05);
  scaleStrength(generic, StrengthLaw::kAsIntended, kGenericBodySize, subject);
  EXPECT_NEAR(subject.muscles[0].max_isometric_force, 1000, tol(1e-9));
}

TEST(Strength, NoneChangesNothing) {
  ModelSpec subject = makeModel(0.07);
  scaleStrength(makeModel(0.05), StrengthLaw::kNone, {}, subject);
  EXPECT_EQ(subject.muscles[0].max_isometric_force, 1000);
}

TEST(Strength, MissingHeightIsRefused) {
  ModelSpec subject = makeModel(0.05);
  EXPECT_THROW(scaleStrength(makeModel(0.05), StrengthLaw::kAsIntended, {85, 0}, subject), Error);
}

}  // namespace
}  // namespace gaitmill
