#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Landmarks that a name may mean when its words are read: "Right_Knee_Lateral", "kneeLat.R",
/// "LeftASIS", "rt heel". Case, separators, order of the side and words such as "marker" do not
/// count. More than one where the name is ambiguous, none where it says nothing.
std::vector<std::string> readMarkerWords(const std::string& name);

/// The name without what stands before its last colon ("Justin:LASI") and in lower case.
std::string simplifyMarkerName(const std::string& name);

}  // namespace gaitmill
