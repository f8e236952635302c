#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gaitmill::api {

/// What one measured marker was taken for.
struct MarkerNameView {
  std::string measured;
  std::string landmark;  ///< empty = none
  double confidence = 0;
  std::string reason;
  std::string set;       ///< of names that says so; empty = none
  std::string proposal;  ///< a landmark that waits for somebody to confirm it; empty = none
  double proposal_confidence = 0;
};

/// Landmarks of one part of the body of which some are needed and not there.
struct MissingLandmarksView {
  std::string part;
  int needed = 0;
  int found = 0;
  std::vector<std::string> any_of;
};

/// The markers of a trial's static poses and movement as landmarks.
struct MarkerNamesView {
  std::string set;  ///< of names that fits best; empty = none
  double set_share = 0;
  std::vector<MarkerNameView> markers;
  std::vector<MissingLandmarksView> missing;
};

/// {"set", "set_share", "markers": [...], "missing": [...]}; empty texts are null.
nlohmann::json toJson(const MarkerNamesView& names);
/// @throws nlohmann::json::exception if the value is no such object
MarkerNamesView toMarkerNames(const nlohmann::json& object);

}  // namespace gaitmill::api
