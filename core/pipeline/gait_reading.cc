#include "core/pipeline/gait_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/intake/landmarks.h"
#include "core/intake/marker_names.h"
#include "core/pipeline/quality_json.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

// Landmarks without their side, the most telling first.
constexpr std::array<const char*, 5> kHeel = {"CAL", "LCA", "MCA", "LMAL", "MMAL"};
constexpr std::array<const char*, 6> kToe = {"TOE", "MT2", "MT1", "MT5", "TIP", "HLX"};

std::vector<int> findMarkers(const MarkerMapping& mapping,
                             const std::vector<std::string>& landmarks) {
  std::vector<int> found;
  for (const std::string& landmark : landmarks) {
    for (std::size_t i = 0; i < mapping.names.size(); ++i) {
      if (mapping.names[i].landmark == landmark) {
        found.push_back(static_cast<int>(i));
      }
    }
  }
  return found;
}

template <std::size_t n>
std::vector<std::string> addSide(char side, const std::array<const char*, n>& landmarks) {
  std::vector<std::string> sided;
  for (const char* landmark : landmarks) {
    sided.push_back(side + std::string(landmark));
  }
  return sided;
}

std::vector<int> listPelvis(const MarkerMapping& mapping) {
  std::vector<int> found;
  for (std::size_t i = 0; i < mapping.names.size(); ++i) {
    const Landmark* landmark = findLandmark(mapping.names[i].landmark);
    const bool measured = landmark != nullptr && landmark->kind != LandmarkKind::kDerived &&
                          landmark->kind != LandmarkKind::kJointCenter;
    if (measured && landmark->body == "pelvis") {
      found.push_back(static_cast<int>(i));
    }
  }
  return found;
}

void useWhereEmpty(const std::vector<int>& other, std::vector<int>& list) {
  if (list.empty()) {
    list = other;
  }
}

Decision decideFootOfPlate(const Gait& gait, Foot named, const std::string& plate) {
  Decision decision;
  decision.part = "grf";
  decision.topic = "foot_of_plate";
  decision.field = "trial.contacts";
  decision.origin =
      named == Foot::kUnknown ? Decision::Origin::kDetected : Decision::Origin::kStated;
  int right = 0;
  int left = 0;
  int none = 0;
  for (const FootContact& contact : gait.contacts) {
    if (contact.plate != plate) {
      continue;
    }
    ++(contact.foot == Foot::kRight ? right : contact.foot == Foot::kLeft ? left : none);
    if (contact.is_stated) {
      decision.origin = Decision::Origin::kSet;
    }
    if (contact.confidence < decision.confidence || decision.evidence.empty()) {
      decision.confidence = std::min(decision.confidence, contact.confidence);
      decision.evidence = "at " + formatFixed(contact.contact.strike, 3) + " s: " + contact.reason;
    }
  }
  decision.value = plate + ": " + std::to_string(right) + " right, " + std::to_string(left) +
                   " left" + (none > 0 ? ", " + std::to_string(none) + " of no single foot" : "");
  return decision;
}

const char* sourceName(GaitEvent::Source source) {
  return source == GaitEvent::Source::kForces ? "forces" : "markers";
}

Json footOrNull(Foot foot) {
  return foot == Foot::kUnknown ? Json(nullptr) : Json(footName(foot));
}

Json toJson(const FootContact& contact) {
  return {{"plate", contact.plate},
          {"foot", footOrNull(contact.foot)},
          {"start_s", contact.contact.strike},
          {"end_s", contact.contact.toe_off},
          {"confidence", toJsonNumber(contact.confidence)},
          {"reason", contact.reason},
          {"flags", listFlags(contact)}};
}

Json toJson(const EventComparison& comparison) {
  return {{"count", comparison.count},
          {"mean_difference_s", comparison.mean_difference},
          {"largest_difference_s", comparison.largest_difference}};
}

Json toJson(const NumberedCycle& cycle) {
  return {{"foot", footName(cycle.foot)},
          {"number", cycle.number},
          {"start_s", cycle.cycle.start},
          {"end_s", cycle.cycle.end},
          {"source", sourceName(cycle.source)},
          {"complete_forces", cycle.has_complete_forces}};
}

Json toJson(const std::optional<SimulatedWindow>& window) {
  if (!window) {
    return nullptr;
  }
  Json object{{"start_s", window->range.start},
              {"end_s", window->range.end},
              {"cycle", nullptr},
              {"realigned", window->is_realigned},
              {"reason", window->reason}};
  if (window->cycle) {
    object["cycle"] = toJson(*window->cycle);
  }
  return object;
}

template <class Value>
Json toList(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) {
    list.push_back(toJson(value));
  }
  return list;
}

}  // namespace

std::vector<std::string> listFlags(const FootContact& contact) {
  std::vector<std::string> flags;
  const auto add = [&](bool holds, const char* flag) {
    if (holds) {
      flags.emplace_back(flag);
    }
  };
  add(contact.is_stated, "stated");
  add(contact.is_shared, "shared");
  add(contact.is_partial, "partial");
  add(contact.is_outside_sole, "outside_sole");
  add(contact.isContradicted(), "wrong_foot");
  return flags;
}

GaitMarkers findGaitMarkersByLandmark(const std::vector<std::string>& names) {
  const MarkerMapping mapping = mapMarkerNames(names);
  const GaitMarkers by_name = findGaitMarkers(names);
  GaitMarkers found;
  found.right = {findMarkers(mapping, addSide('R', kHeel)),
                 findMarkers(mapping, addSide('R', kToe))};
  found.left = {findMarkers(mapping, addSide('L', kHeel)),
                findMarkers(mapping, addSide('L', kToe))};
  found.pelvis = listPelvis(mapping);
  useWhereEmpty(by_name.right.heel, found.right.heel);
  useWhereEmpty(by_name.right.toe, found.right.toe);
  useWhereEmpty(by_name.left.heel, found.left.heel);
  useWhereEmpty(by_name.left.toe, found.left.toe);
  useWhereEmpty(by_name.pelvis, found.pelvis);
  return found;
}

void addGaitDecisions(const Gait& gait,
                      const std::vector<Foot>& named,
                      const GroundReaction& plates,
                      Decisions& decisions) {
  for (std::size_t i = 0; i < named.size(); ++i) {
    decisions.push_back(decideFootOfPlate(gait, named[i], plates.forces[i].name));
  }
  if (gait.kind != GaitKind::kUnknown) {
    // The further the stance is from half of the stride, the surer.
    const double away = std::isnan(gait.duty_factor) ? 0.1 : std::abs(gait.duty_factor - 0.5);
    decisions.push_back({"",
                         "gait",
                         "",
                         gaitKindName(gait.kind),
                         Decision::Origin::kDetected,
                         1 / (1 + std::exp(-away / 0.03)),
                         gait.kind_evidence});
  }
  if (gait.window) {
    const std::string cycle = gait.window->cycle
                                  ? std::string(footName(gait.window->cycle->foot)) + " " +
                                        std::to_string(gait.window->cycle->number) + ", "
                                  : "";
    decisions.push_back({"",
                         "simulated_window",
                         "trial.cycle",
                         cycle + formatFixed(gait.window->range.start, 3) + " to " +
                             formatFixed(gait.window->range.end, 3) + " s",
                         Decision::Origin::kDetected,
                         1,
                         gait.window->reason});
  }
}

std::string describeAsJson(const Gait& gait) {
  Json complete = Json::array();
  for (const TimeRange& range : gait.coverage.complete) {
    complete.push_back({range.start, range.end});
  }
  Json missing = Json::array();
  for (const MissingForce& one : gait.coverage.missing) {
    missing.push_back({{"foot", footOrNull(one.foot)},
                       {"start_s", one.range.start},
                       {"end_s", one.range.end},
                       {"reason", one.reason}});
  }
  const Json json{{"kind", gaitKindName(gait.kind)},
                  {"duty_factor", toJsonNumber(gait.duty_factor)},
                  {"evidence", gait.kind_evidence},
                  {"contacts", toList(gait.contacts)},
                  {"complete_forces_s", complete},
                  {"missing_forces", missing},
                  {"marker_events",
                   {{"foot_strikes", toJson(gait.strikes)}, {"toe_offs", toJson(gait.toe_offs)}}},
                  {"cycles", toList(gait.cycles)},
                  {"window", toJson(gait.window)}};
  return json.dump();
}

}  // namespace gaitmill
