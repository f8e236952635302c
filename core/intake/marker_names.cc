#include "core/intake/marker_names.h"

#include <algorithm>
#include <cstddef>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "core/intake/landmarks.h"
#include "core/intake/marker_name_sets.h"
#include "core/intake/marker_words.h"

namespace gaitmill {

namespace {

constexpr double kStated = 1.0;
constexpr double kOwnSet = 0.98;
constexpr double kOtherSets = 0.9;
constexpr double kDisputed = 0.6;
constexpr double kWords = 0.75;
constexpr double kAmbiguousWords = 0.4;

/// The names of one set as they are compared.
using NameIndex = std::map<std::string, std::string>;

NameIndex makeIndex(const MarkerNameSet& set) {
  NameIndex index;
  for (const NamedMarker& marker : set.markers) {
    index.emplace(simplifyMarkerName(marker.name), marker.landmark);
  }
  return index;
}

const std::vector<NameIndex>& setIndices() {
  static const std::vector<NameIndex> indices = [] {
    std::vector<NameIndex> all;
    for (const MarkerNameSet& set : markerNameSets()) {
      all.push_back(makeIndex(set));
    }
    return all;
  }();
  return indices;
}

/// How well a set fits, and its place in markerNameSets().
struct SetFit {
  std::size_t set = 0;
  int matched = 0;     // measured names that are its
  double covered = 0;  // share of its own names that were measured
};

/// Best first: most names, then the set that is used most completely.
std::vector<SetFit> rankSets(const std::vector<std::string>& simplified) {
  std::vector<SetFit> fits;
  for (std::size_t i = 0; i < setIndices().size(); ++i) {
    SetFit fit;
    fit.set = i;
    for (const std::string& name : simplified) {
      fit.matched += static_cast<int>(setIndices()[i].count(name));
    }
    fit.covered = fit.matched / std::max(1.0, static_cast<double>(setIndices()[i].size()));
    fits.push_back(fit);
  }
  std::stable_sort(fits.begin(), fits.end(), [](const SetFit& a, const SetFit& b) {
    return a.matched != b.matched ? a.matched > b.matched : a.covered > b.covered;
  });
  return fits;
}

/// Points that motion capture software computes and stores beside the markers.
bool isModelOutput(const std::string& measured) {
  // Segment axes and results of Plug-in Gait (Plug-in Gait Reference Guide, outputs).
  static const std::regex output(
      "([LR](FE|TI|FO|TO|CL|HU|RA|HN)|PEL|TRX|HED|THX|SPI)[OALP]|"
      ".*(Angles|Force|Moment|Power|AbsAngles|Forces|Moments|Powers)|"
      "CentreOfMass(Floor)?|(CentreOfPressure|GroundReaction).*|"
      "(HED|THX|PEL|[LR](FE|TI|FO|HU|RA|HN))[XYZ]",
      std::regex::optimize);
  const std::size_t colon = measured.rfind(':');
  const std::string name = colon == std::string::npos ? measured : measured.substr(colon + 1);
  return name.size() <= 64 && std::regex_match(name, output);
}

bool isUnlabelled(const std::string& simplified) {
  return simplified.empty() || simplified[0] == '*';
}

void use(MarkerName& name, const std::string& landmark, double confidence, std::string reason) {
  name.landmark = landmark;
  name.confidence = confidence;
  name.reason = std::move(reason);
}

std::string describe(const std::string& landmark) {
  const Landmark* found = findLandmark(landmark);
  return found == nullptr ? landmark : found->description;
}

bool mapByOwnSet(const SetFit& best, const std::string& simplified, MarkerName& name) {
  const auto found = setIndices()[best.set].find(simplified);
  if (best.matched == 0 || found == setIndices()[best.set].end()) {
    return false;
  }
  name.set = markerNameSets()[best.set].name;
  if (found->second.empty()) {
    name.reason = "a name of " + name.set + " that stands for no landmark";
    return true;
  }
  use(name, found->second, kOwnSet, describe(found->second) + ", as " + name.set + " names it");
  return true;
}

bool mapByOtherSets(const std::vector<SetFit>& fits,
                    const std::string& simplified,
                    MarkerName& name) {
  std::set<std::string> meanings;
  const SetFit* first = nullptr;
  for (const SetFit& fit : fits) {
    const auto found = setIndices()[fit.set].find(simplified);
    if (found != setIndices()[fit.set].end() && !found->second.empty()) {
      first = first == nullptr ? &fit : first;
      meanings.insert(found->second);
    }
  }
  if (first == nullptr) {
    return false;
  }
  const std::string& landmark = setIndices()[first->set].at(simplified);
  name.set = markerNameSets()[first->set].name;
  use(name,
      landmark,
      meanings.size() == 1 ? kOtherSets : kDisputed,
      describe(landmark) + ", as " + name.set + " names it" +
          (meanings.size() == 1 ? "" : "; other sets mean another place by this name"));
  return true;
}

bool mapByWords(const std::string& measured, MarkerName& name) {
  const std::vector<std::string> meant = readMarkerWords(measured);
  if (meant.empty()) {
    return false;
  }
  if (meant.size() == 1) {
    use(name, meant[0], kWords, describe(meant[0]) + ", by the words of the name");
    return true;
  }
  name.proposal = meant[0];
  name.proposal_confidence = kAmbiguousWords;
  name.reason = "the words of the name fit more than one landmark: ";
  for (const std::string& landmark : meant) {
    name.reason += (landmark == meant[0] ? "" : ", ") + landmark;
  }
  return true;
}

MarkerName mapByName(const std::string& measured, const std::vector<SetFit>& fits) {
  MarkerName name;
  name.measured = measured;
  const std::string simplified = simplifyMarkerName(measured);
  if (isUnlabelled(simplified)) {
    name.reason = "has no label";
  } else if (isModelOutput(measured)) {
    name.reason = "a result that motion capture software stored, not a marker";
  } else if (!mapByOwnSet(fits.front(), simplified, name) &&
             !mapByOtherSets(fits, simplified, name) && !mapByWords(measured, name)) {
    name.reason = "no known set has this name";
  }
  return name;
}

[[noreturn]] void refuseOverride(const std::string& measured,
                                 const std::string& sentence,
                                 const std::string& nearest) {
  throw Error(ErrorCode::kMarkerNames,
              sentence + (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
              {{}, 0, 0, "marker_names." + measured});
}

void checkOverrides(const std::vector<std::string>& measured, const MarkerOverrides& overrides) {
  const std::set<std::string> there(measured.begin(), measured.end());
  std::map<std::string, std::string> taken;
  for (const auto& [name, landmark] : overrides) {
    if (there.count(name) == 0) {
      refuseOverride(
          name, "no marker '" + name + "' was measured", findNearestName(name, measured));
    }
    if (!landmark) {
      continue;
    }
    requireLandmark(*landmark, {{}, 0, 0, "marker_names." + name});
    const auto [other, is_new] = taken.emplace(*landmark, name);
    if (!is_new) {
      refuseOverride(
          name, "landmark '" + *landmark + "' is given to '" + other->second + "' too", "");
    }
  }
}

void applyOverrides(const MarkerOverrides& overrides, MarkerMapping& mapping) {
  for (MarkerName& name : mapping.names) {
    const auto stated = overrides.find(name.measured);
    if (stated == overrides.end()) {
      continue;
    }
    name = {name.measured, "", 0, "to be ignored, as stated", "", "", 0};
    if (stated->second) {
      use(name, *stated->second, kStated, describe(*stated->second) + ", as stated");
    }
  }
}

/// Leaves each landmark to the marker that is surest of it, the first of equals.
void settleDuplicates(MarkerMapping& mapping) {
  std::map<std::string, MarkerName*> owners;
  for (MarkerName& name : mapping.names) {
    if (name.landmark.empty()) {
      continue;
    }
    MarkerName*& owner = owners[name.landmark];
    if (owner == nullptr) {
      owner = &name;
      continue;
    }
    MarkerName* loser = name.confidence > owner->confidence ? owner : &name;
    owner = loser == owner ? &name : owner;
    loser->reason = "'" + owner->measured + "' is " + loser->landmark + " already";
    loser->landmark.clear();
    loser->confidence = 0;
  }
}

/// A part of the body and the landmarks that say where it is; "@" stands for the side, and such a
/// part is needed on both. Clusters do where the places that scaling prefers are not marked, as in
/// movements whose static trial has them.
struct Need {
  const char* part;
  int count;
  std::vector<const char*> any_of;
  std::vector<const char*> cluster = {};  // two of these do as well
};

constexpr int kEnoughOfCluster = 2;

// What has to be there for every segment of the legs and the trunk to have a place: three points of
// the pelvis, one at each joint below it, two of each foot, two of the trunk. Arms may be missing.
// clang-format off
const std::vector<Need>& needs() {
  static const std::vector<Need> all = {
      {"pelvis", 3, {"RASI", "LASI", "RPSI", "LPSI", "SACR", "S2", "RILC", "LILC", "RHJC", "LHJC"}},
      {"@ knee", 1, {"@LFC", "@MFC", "@FCmid", "@KJC"}, {"@TH1", "@TH2", "@TH3", "@TH4", "@THI", "@THAP", "@THAD"}},
      {"@ ankle", 1, {"@LMAL", "@MMAL", "@MALmid", "@AJC"}, {"@TB1", "@TB2", "@TB3", "@TB4", "@TIB", "@TIAP", "@TIAD"}},
      {"@ foot", 2, {"@CAL", "@TOE", "@MT1", "@MT2", "@MT5", "@TIP", "@HLX", "@TO5", "@DFT", "@B5M"}},
      {"trunk", 2, {"C7", "CLAV", "STRN", "XIPH", "T10", "T8", "RACR", "LACR", "RCLV", "LCLV", "RSJC", "LSJC", "SJCmid"}}};
  return all;
}
// clang-format on

std::string putSide(std::string text, bool right, const char* word) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos) {
    return text;
  }
  return text.replace(at, 1, word != nullptr ? word : right ? "R" : "L");
}

void addMissing(const Need& need,
                bool right,
                const MarkerMapping& mapping,
                std::vector<MissingLandmarks>& missing) {
  MissingLandmarks group;
  group.part = putSide(need.part, right, right ? "right" : "left");
  group.needed = need.count;
  for (const char* landmark : need.any_of) {
    group.any_of.push_back(putSide(landmark, right, nullptr));
    group.found += mapping.findMeasured(group.any_of.back()) != nullptr ? 1 : 0;
  }
  int of_cluster = 0;
  for (const char* landmark : need.cluster) {
    of_cluster += mapping.findMeasured(putSide(landmark, right, nullptr)) != nullptr ? 1 : 0;
  }
  if (group.found < group.needed && of_cluster < kEnoughOfCluster) {
    missing.push_back(std::move(group));
  }
}

}  // namespace

const std::string* MarkerMapping::findMeasured(const std::string& landmark) const {
  for (const MarkerName& name : names) {
    if (!landmark.empty() && name.landmark == landmark) {
      return &name.measured;
    }
  }
  return nullptr;
}

const MarkerName* MarkerMapping::find(const std::string& measured) const {
  for (const MarkerName& name : names) {
    if (name.measured == measured) {
      return &name;
    }
  }
  return nullptr;
}

std::vector<std::string> MarkerMapping::listUnmapped() const {
  std::vector<std::string> unmapped;
  for (const MarkerName& name : names) {
    if (name.landmark.empty()) {
      unmapped.push_back(name.measured);
    }
  }
  return unmapped;
}

MarkerMapping mapMarkerNames(const std::vector<std::string>& measured,
                             const MarkerOverrides& overrides) {
  checkOverrides(measured, overrides);
  std::vector<std::string> simplified;
  for (const std::string& name : measured) {
    simplified.push_back(simplifyMarkerName(name));
  }
  const std::vector<SetFit> fits = rankSets(simplified);
  MarkerMapping mapping;
  if (fits.front().matched > 0) {
    mapping.set = markerNameSets()[fits.front().set].name;
    mapping.set_share = fits.front().matched / static_cast<double>(measured.size());
  }
  for (const std::string& name : measured) {
    mapping.names.push_back(mapByName(name, fits));
  }
  applyOverrides(overrides, mapping);
  settleDuplicates(mapping);
  return mapping;
}

std::vector<MissingLandmarks> listMissingLandmarks(const MarkerMapping& mapping) {
  std::vector<MissingLandmarks> missing;
  for (const Need& need : needs()) {
    addMissing(need, true, mapping, missing);
    if (std::string(need.part).find('@') != std::string::npos) {
      addMissing(need, false, mapping, missing);
    }
  }
  return missing;
}

std::string describeMissing(const std::vector<MissingLandmarks>& missing) {
  std::string text;
  for (const MissingLandmarks& group : missing) {
    text += (text.empty() ? "" : "; ") + group.part + " (" + std::to_string(group.found) + " of " +
            std::to_string(group.needed) + ", any of";
    for (const std::string& landmark : group.any_of) {
      text += " " + landmark;
    }
    text += ")";
  }
  return text;
}

}  // namespace gaitmill
