#include "core/intake/angle_unit.h"

#include <string>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr double kLeastPeak = 0.15;   // [rad]
constexpr double kLargestPeak = 3.6;  // [rad]

bool isMovement(double peak) {
  return peak >= kLeastPeak && peak <= kLargestPeak;
}

double toRadiansIf(bool degrees, double value) {
  return degrees ? toRadians(value) : value;
}

std::string describe(double peak, bool degrees) {
  return std::string("read in ") + (degrees ? "degrees" : "radians") +
         ", the largest joint angle is " + formatFixed(toDegrees(toRadiansIf(degrees, peak)), 2) +
         " degrees";
}

}  // namespace

bool decideAngleUnit(double peak,
                     const StatedAngles& stated,
                     const std::optional<bool>& set,
                     Decisions& decisions) {
  Decision decision;
  decision.part = "coordinates";
  decision.topic = "angle_units";
  decision.field = "trial.angle_units";
  bool degrees = set.value_or(stated.degrees);
  decision.origin = set                ? Decision::Origin::kSet
                    : stated.is_stated ? Decision::Origin::kStated
                                       : Decision::Origin::kAssumed;
  const bool fits = isMovement(toRadiansIf(degrees, peak));
  const bool other_fits = isMovement(toRadiansIf(!degrees, peak));
  if (!set && !fits && other_fits) {
    require(!stated.is_stated,
            ErrorCode::kInputAmbiguous,
            std::string("the header says ") + (degrees ? "degrees" : "radians") + "; " +
                describe(peak, degrees) + ", but " + describe(peak, !degrees) +
                ". State trial.angle_units",
            {{}, 0, 0, "trial.angle_units"});
    degrees = !degrees;
    decision.origin = Decision::Origin::kDetected;
  }
  decision.confidence = fits != other_fits ? 0.95 : 0.5;
  decision.value = degrees ? "deg" : "rad";
  decision.evidence = describe(peak, degrees);
  decisions.push_back(decision);
  return degrees;
}

}  // namespace gaitmill
