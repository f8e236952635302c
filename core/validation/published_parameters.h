#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gaitmill {

/// A printed mean with its standard deviation; NaN where none is printed.
struct PublishedValue {
  double mean = 0;
  double sd = std::numeric_limits<double>::quiet_NaN();
};

/// Parameters of one muscle of Rajagopal2016 as Supplemental Table I of Rajagopal et al. (2016)
/// prints them, rounded to 1 N, 0.1 cm, 0.1 deg. (Table II differs in three last digits.)
struct PublishedParameters {
  std::string muscle;            ///< without side
  std::string volume_of;         ///< measured muscle whose volume it shares: "addmag"
  std::string fibers_of;         ///< measured muscle whose fibers it shares
  PublishedValue force_n;        ///< maximum isometric force
  PublishedValue fiber_cm;       ///< optimal fiber length
  PublishedValue slack_cm;       ///< tendon slack length
  PublishedValue pennation_deg;  ///< at optimal fiber length
};

/// The forty muscles of a leg, in the model's order.
const std::vector<PublishedParameters>& publishedParameters();

/// Half a unit of the last printed digit.
inline constexpr double kForceRounding_n = 0.5;
inline constexpr double kLengthRounding_cm = 0.05;
inline constexpr double kAngleRounding_deg = 0.05;

/// Row of that muscle (without side), or null.
const PublishedParameters* findPublished(const std::string& base);

}  // namespace gaitmill
