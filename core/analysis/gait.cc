#include "core/analysis/gait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

using Kind = GaitEvent::Kind;
using Source = GaitEvent::Source;

constexpr double kMatchReach = 0.12;        // [s] an event by markers is that of the forces
constexpr double kWalkingDutyFactor = 0.5;  // above it both feet stand at the same time
constexpr double kLeastDutyFactor = 0.2;    // sprinters reach 0.22
constexpr double kLargestDutyFactor = 0.75;
constexpr double kLargestDisorder = 0.2;  // share of events that do not alternate
constexpr double kTellDifference = 0.05;  // [s] between forces and markers, on average
constexpr std::size_t kReasonsTold = 3;

std::string formatRange(double start, double end) {
  return formatFixed(start, 3) + " to " + formatFixed(end, 3) + " s";
}

void sortByTime(std::vector<GaitEvent>& events) {
  std::stable_sort(events.begin(), events.end(), [](const GaitEvent& a, const GaitEvent& b) {
    return a.time < b.time;
  });
}

/// Share of a foot's events that follow one of their own kind.
double calcDisorder(const std::vector<GaitEvent>& events) {
  int pairs = 0;
  int disordered = 0;
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    const GaitEvent* last = nullptr;
    for (const GaitEvent& event : events) {
      if (event.foot == foot) {
        pairs += last != nullptr ? 1 : 0;
        disordered += last != nullptr && last->kind == event.kind ? 1 : 0;
        last = &event;
      }
    }
  }
  return pairs > 0 ? static_cast<double>(disordered) / pairs : 0.0;
}

/// Events by markers, or none with a warning if they cannot be those of gait.
std::vector<GaitEvent> findTrustedMarkerEvents(const GaitMotion& motion,
                                               std::vector<std::string>& warnings) {
  std::vector<GaitEvent> events = findMarkerEvents(motion);
  const double duty = calcDutyFactor(events);
  const bool possible =
      std::isnan(duty) || (duty >= kLeastDutyFactor && duty <= kLargestDutyFactor);
  const double disorder = calcDisorder(events);
  if (possible && disorder <= kLargestDisorder) {
    return events;
  }
  warnings.push_back(
      "gait events of the markers are not used: " +
      (possible ? formatFixed(100 * disorder, 0) + " % of them do not alternate"
                : "the feet would stand " + formatFixed(100 * duty, 0) + " % of the stride"));
  return {};
}

/// Adds to the events of the forces what only the markers tell.
class EventMerger {
 public:
  EventMerger(const std::vector<FootContact>& contacts, std::vector<GaitEvent> marker_events)
      : contacts_(contacts),
        events_(findGaitEvents(contacts)),
        marker_events_(std::move(marker_events)),
        is_taken_(marker_events_.size(), false) {}

  std::vector<GaitEvent> merge() {
    for (GaitEvent& event : events_) {
      if (const std::optional<std::size_t> match = findMatch(event)) {
        is_taken_[*match] = true;
        event.marker_difference = marker_events_[*match].time - event.time;
      }
    }
    std::vector<GaitEvent> merged = events_;
    for (std::size_t i = 0; i < marker_events_.size(); ++i) {
      if (!is_taken_[i] && !isContradicted(marker_events_[i])) {
        merged.push_back(marker_events_[i]);
      }
    }
    sortByTime(merged);
    return merged;
  }

 private:
  std::optional<std::size_t> findMatch(const GaitEvent& event) const {
    std::optional<std::size_t> best;
    double nearest = kMatchReach;
    for (std::size_t i = 0; i < marker_events_.size(); ++i) {
      const GaitEvent& other = marker_events_[i];
      const double away = std::abs(other.time - event.time);
      if (!is_taken_[i] && other.kind == event.kind && other.foot == event.foot && away < nearest) {
        nearest = away;
        best = i;
      }
    }
    return best;
  }

  /// A force of that foot was there before and behind the event.
  bool isContradicted(const GaitEvent& event) const {
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const FootContact& contact) {
      const double slack = kMatchReach;
      const bool starts = contact.contact.has_strike;
      const bool ends = contact.contact.has_toe_off;
      return contact.isUsable() && !contact.is_partial && contact.foot == event.foot &&
             event.time > contact.contact.strike - (starts ? slack : 0) &&
             event.time < contact.contact.toe_off + (ends ? slack : 0) &&
             (starts || event.kind == Kind::kFootStrike) && (ends || event.kind == Kind::kToeOff);
    });
  }

  const std::vector<FootContact>& contacts_;
  std::vector<GaitEvent> events_;
  std::vector<GaitEvent> marker_events_;
  std::vector<bool> is_taken_;
};

EventComparison compareEvents(const std::vector<GaitEvent>& events, Kind kind) {
  EventComparison comparison;
  double sum = 0;
  for (const GaitEvent& event : events) {
    if (event.kind == kind && !std::isnan(event.marker_difference)) {
      ++comparison.count;
      sum += event.marker_difference;
      comparison.largest_difference =
          std::max(comparison.largest_difference, std::abs(event.marker_difference));
    }
  }
  comparison.mean_difference = comparison.count > 0 ? sum / comparison.count : 0.0;
  return comparison;
}

/// Whether two feet are loaded at the same time.
bool hasDoubleSupport(const std::vector<FootContact>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const bool opposite =
          contacts[i].isUsable() && contacts[j].foot == otherFoot(contacts[i].foot);
      if (contacts[i].is_shared ||
          (opposite && contacts[j].contact.strike < contacts[i].contact.toe_off)) {
        return true;
      }
    }
  }
  return false;
}

void findKind(Gait& gait) {
  gait.duty_factor = calcDutyFactor(gait.events);
  if (!std::isnan(gait.duty_factor)) {
    const bool walks = gait.duty_factor >= kWalkingDutyFactor;
    gait.kind = walks ? GaitKind::kWalking : GaitKind::kRunning;
    gait.kind_evidence =
        "a foot stands " + formatFixed(100 * gait.duty_factor, 0) + " % of its stride";
  } else if (hasDoubleSupport(gait.contacts)) {
    gait.kind = GaitKind::kWalking;
    gait.kind_evidence = "both feet are loaded at the same time";
  } else {
    gait.kind_evidence = "no whole stride is seen";
  }
}

/// What is to be said about a contact, behind its plate and time; empty if nothing.
struct Finding {
  const char* problem = "";
  std::string advice;
};

std::optional<Finding> findProblem(const FootContact& contact) {
  if (contact.is_foreign) {
    return std::nullopt;
  }
  if (contact.is_shared) {
    return Finding{"both feet stand there", "this time is not simulated by default"};
  }
  if (contact.foot == Foot::kUnknown) {
    return Finding{"which foot stands there cannot be told",
                   "its force is not used unless trial.contacts states the foot"};
  }
  if (contact.isContradicted()) {
    return Finding{"wrong foot?",
                   std::string("the ") + footName(contact.seen) +
                       " foot is where the force acts; trial.contacts or trial.plates change it"};
  }
  if (contact.is_outside_sole) {
    return Finding{"the centre of pressure lies beside the foot", "is the plate where it is said?"};
  }
  return std::nullopt;
}

/// One sentence per plate and problem.
void warnOfContacts(const std::vector<FootContact>& contacts, std::vector<std::string>& warnings) {
  struct Group {
    const FootContact* first;
    Finding finding;
    int count;
  };
  std::vector<Group> groups;
  for (const FootContact& contact : contacts) {
    const std::optional<Finding> finding = findProblem(contact);
    if (!finding) {
      continue;
    }
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return group.first->plate == contact.plate &&
             std::string(group.finding.problem) == finding->problem;
    });
    if (known == groups.end()) {
      groups.push_back({&contact, *finding, 1});
    } else {
      ++known->count;
    }
  }
  for (const Group& group : groups) {
    const Contact& time = group.first->contact;
    const std::string more =
        group.count > 1 ? " and " + std::to_string(group.count - 1) + " more contacts" : "";
    warnings.push_back(
        "plate '" + group.first->plate + "', " + formatRange(time.strike, time.toe_off) + more +
        ": " + group.finding.problem + " (" + group.first->reason + "); " + group.finding.advice);
  }
}

void warnOfCoverage(const Gait& gait, const TimeRange& record, std::vector<std::string>& warnings) {
  if (gait.coverage.missing.empty() || gait.contacts.empty()) {
    return;
  }
  std::string sentence = "forces are complete ";
  if (gait.coverage.complete.empty()) {
    sentence += "nowhere";
  }
  for (const TimeRange& range : gait.coverage.complete) {
    sentence += (&range == gait.coverage.complete.data() ? "only from " : ", ") +
                formatRange(range.start, range.end);
  }
  sentence += " of " + formatRange(record.start, record.end) + ": ";
  const std::size_t told = std::min(kReasonsTold, gait.coverage.missing.size());
  for (std::size_t i = 0; i < told; ++i) {
    sentence += (i == 0 ? "" : "; ") + gait.coverage.missing[i].reason;
  }
  if (told < gait.coverage.missing.size()) {
    sentence += "; and " + std::to_string(gait.coverage.missing.size() - told) + " more";
  }
  warnings.push_back(sentence);
}

void warnOfEvents(const Gait& gait, std::vector<std::string>& warnings) {
  for (const auto& [comparison, name] :
       {std::pair{gait.strikes, "foot strikes"}, std::pair{gait.toe_offs, "toe-offs"}}) {
    if (comparison.count > 0 && std::abs(comparison.mean_difference) > kTellDifference) {
      warnings.push_back(std::string(name) + " by the markers differ from those by the forces by " +
                         formatFixed(1000 * comparison.mean_difference, 0) +
                         " ms on average; the forces count, but their times may be shifted");
    }
  }
}

TimeRange findRecord(const GroundReaction& reaction, const MarkerTrajectories& markers) {
  TimeRange record;
  for (const std::vector<double>* time : {&reaction.time, &markers.time}) {
    if (!time->empty()) {
      record.start = std::max(record.start, time->front());
      record.end = std::min(record.end, time->back());
    }
  }
  return record;
}

void findCyclesAndWindow(const TimeRange& record,
                         bool has_forces,
                         const GaitStatements& statements,
                         Gait& gait) {
  gait.cycles = listCycles(gait.events, gait.coverage.complete);
  if (!has_forces) {
    return;
  }
  if (statements.cycle_range) {
    const GaitCycle stated{statements.cycle_range->start, statements.cycle_range->end};
    gait.window = findWindowOfCycle({Foot::kRight, 0, stated}, gait.coverage.complete, record);
    // Whoever states a cycle need not be told that its ends are cut.
    gait.window->warning.clear();
    return;
  }
  gait.window = findWindow(gait.cycles, gait.coverage.complete, record, statements.cycle);
  if (gait.window && !gait.window->warning.empty()) {
    gait.warnings.push_back(gait.window->warning);
  } else if (!gait.window) {
    gait.warnings.emplace_back(
        "at no time are the forces of both feet complete; all of the recording is simulated with "
        "the forces that there are");
  }
}

/// Divides one force among the feet of its contacts.
class ForceDivider {
 public:
  ForceDivider(const GroundReaction& reaction,
               const ExternalForce& force,
               const std::vector<FootContact>& contacts)
      : time_(reaction.time), force_(force) {
    for (const FootContact& contact : contacts) {
      if (contact.plate == force.name) {
        contacts_.push_back(&contact);
      }
    }
  }

  bool hasFoot(Foot foot) const {
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const FootContact* contact) {
      return contact->isUsable() && contact->foot == foot;
    });
  }

  /// Whether every contact belongs to that foot.
  bool isOf(Foot foot) const {
    return std::all_of(contacts_.begin(), contacts_.end(), [&](const FootContact* contact) {
      return contact->isUsable() && contact->foot == foot;
    });
  }

  ExternalForce take(Foot foot) const {
    ExternalForce part = force_;
    for (std::size_t row = 0; row < time_.size(); ++row) {
      if (findFoot(time_[row]) != foot) {
        part.force.col(static_cast<Eigen::Index>(row)).setZero();
        part.torque.col(static_cast<Eigen::Index>(row)).setZero();
      }
    }
    return part;
  }

 private:
  /// The foot of the contact that is nearest in time.
  Foot findFoot(double time) const {
    const FootContact* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const FootContact* contact : contacts_) {
      const double away =
          std::max({0.0, contact->contact.strike - time, time - contact->contact.toe_off});
      // What two feet share goes to the nearer neighbour that it touches.
      const double penalty = contact->is_shared && hasNeighbour(*contact) ? kSharedPenalty : 0.0;
      if (away + penalty < least) {
        least = away + penalty;
        nearest = contact;
      }
    }
    return nearest == nullptr || nearest->is_shared ? Foot::kUnknown : nearest->foot;
  }

  bool hasNeighbour(const FootContact& shared) const {
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const FootContact* contact) {
      return contact->isUsable() && (contact->contact.toe_off == shared.contact.strike ||
                                     contact->contact.strike == shared.contact.toe_off);
    });
  }

  static constexpr double kSharedPenalty = 1e3;  // [s]

  const std::vector<double>& time_;
  const ExternalForce& force_;
  std::vector<const FootContact*> contacts_;
};

}  // namespace

Gait describeGait(const GroundReaction& reaction,
                  const std::vector<Foot>& named,
                  const MarkerTrajectories& markers,
                  const GaitMarkers& chosen,
                  const GaitStatements& statements) {
  Gait gait;
  const TimeRange record = findRecord(reaction, markers);
  const GaitMotion motion = makeGaitMotion(markers, chosen);
  const std::vector<GaitEvent> marker_events = findTrustedMarkerEvents(motion, gait.warnings);
  if (!markers.time.empty()) {
    gait.stances = findStances(marker_events, markers.time.front(), markers.time.back());
  }
  gait.contacts = findFootContacts(reaction, named, motion, marker_events, statements.contacts);
  gait.events = EventMerger(gait.contacts, marker_events).merge();
  findKind(gait);
  if (!reaction.forces.empty() && record.start < record.end) {
    gait.coverage = findForceCoverage(gait.stances, gait.kind, record, gait.contacts);
    // Contacts that turned out to miss a part of their stance tell no events.
    gait.events = EventMerger(gait.contacts, marker_events).merge();
  }
  gait.strikes = compareEvents(gait.events, Kind::kFootStrike);
  gait.toe_offs = compareEvents(gait.events, Kind::kToeOff);
  warnOfContacts(gait.contacts, gait.warnings);
  warnOfCoverage(gait, record, gait.warnings);
  warnOfEvents(gait, gait.warnings);
  findCyclesAndWindow(
      record, !reaction.forces.empty() && record.start < record.end, statements, gait);
  return gait;
}

GroundReaction assignForces(const GroundReaction& reaction,
                            const std::vector<Foot>& named,
                            const std::vector<FootContact>& contacts,
                            const std::string& right_body,
                            const std::string& left_body) {
  check(named.size() == reaction.forces.size(), "every force needs its foot, known or not");
  GroundReaction assigned;
  assigned.time = reaction.time;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const ExternalForce& force = reaction.forces[i];
    const ForceDivider divider(reaction, force, contacts);
    if (named[i] != Foot::kUnknown && divider.isOf(named[i])) {
      assigned.forces.push_back(force);
      continue;
    }
    for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
      if (!divider.hasFoot(foot)) {
        continue;
      }
      assigned.forces.push_back(divider.isOf(foot) ? force : divider.take(foot));
      assigned.forces.back().body = foot == Foot::kRight ? right_body : left_body;
    }
  }
  return assigned;
}

}  // namespace gaitmill
