#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill {

// Which landmark each measured marker is, told from its name.

/// What one measured marker was taken for.
struct MarkerName {
  std::string measured;   ///< as the file names it
  std::string landmark;   ///< of landmarks(); empty = not used as a landmark
  double confidence = 0;  ///< [0, 1] in the landmark; 0 without one
  std::string reason;     ///< a sentence for people
  std::string set;        ///< the set of names that says so; empty = none
  /// A landmark that may be meant, where `landmark` is empty: never used unless somebody confirms
  /// it.
  std::string proposal;
  double proposal_confidence = 0;  ///< [0, 1]; 0 without one
};

/// All measured markers, none left out, in their order. A landmark stands at most once.
struct MarkerMapping {
  std::string set;       ///< the set of names that fits best; empty = none has a single one
  double set_share = 0;  ///< of the measured names that are its
  std::vector<MarkerName> names;
  std::vector<std::string> warnings;

  /// The measured name of a landmark. @returns nullptr if it was not measured
  const std::string* findMeasured(const std::string& landmark) const;
  /// @returns nullptr if no such marker was measured
  const MarkerName* find(const std::string& measured) const;
  std::vector<std::string> listUnmapped() const;
};

/// Landmarks by measured name as a user states them; nullopt = this marker is to be ignored.
using MarkerOverrides = std::map<std::string, std::optional<std::string>>;

/// Below this confidence a landmark is proposed, not used.
inline constexpr double kUsableConfidence = 0.5;

/// Maps by name: what the user states (confidence 1), then the names of the set that most measured
/// names belong to (0.98), then those of other sets (0.9 where all that know the name agree, else
/// 0.6), then names written in other ways: other case and separators, a prefix "Subject:", words
/// such as "right_knee_lateral" (0.75). Of two markers for one landmark the surer one is taken.
/// @throws Error kMarkerNames for an override of a marker that was not measured or to a landmark
///   that does not exist, with the nearest name, or to one landmark twice
MarkerMapping mapMarkerNames(const std::vector<std::string>& measured,
                             const MarkerOverrides& overrides = {});

/// A group of landmarks of which scaling and inverse kinematics need some.
struct MissingLandmarks {
  std::string part;  ///< "right knee"
  int needed = 1;    ///< how many of `any_of`
  int found = 0;
  std::vector<std::string> any_of;
};

/// The parts of the body that the mapping does not determine; empty = everything is there.
std::vector<MissingLandmarks> listMissingLandmarks(const MarkerMapping& mapping);

/// "right knee (1 of RLFC, RFCmid, RKJC), left foot (...)"
std::string describeMissing(const std::vector<MissingLandmarks>& missing);

}  // namespace gaitmill
