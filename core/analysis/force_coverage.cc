#include "core/analysis/force_coverage.h"

#include <algorithm>
#include <optional>

#include "core/base/text.h"

namespace gaitmill {

namespace {

// Shorter intervals of complete forces are of no use to anyone [s].
constexpr double kLeastInterval = 0.05;

std::string formatRange(double start, double end) {
  return formatFixed(start, 3) + " to " + formatFixed(end, 3) + " s";
}

/// Finds what is missing, stance by stance and contact by contact.
class CoverageSearch {
 public:
  explicit CoverageSearch(std::vector<FootContact>& contacts) : contacts_(contacts) {}

  void lookAtStance(const Stance& stance) {
    const std::vector<FootContact*> own = findContactsOf(stance);
    if (own.empty()) {
      addMissing(stance.foot, stance.start, stance.end, "stands without a force");
      return;
    }
    double covered_until = stance.start;
    for (FootContact* contact : own) {
      const bool is_first = contact == own.front();
      const bool counts = !is_first || (stance.has_strike && contact->contact.has_strike);
      const double gap = contact->contact.strike - covered_until;
      if (counts && gap > kLargestEventError) {
        addPartial(stance, covered_until, contact->contact.strike, *contact);
      }
      covered_until = std::max(covered_until, contact->contact.toe_off);
    }
    const bool counts = stance.has_toe_off && own.back()->contact.has_toe_off;
    if (counts && stance.end - covered_until > kLargestEventError) {
      addPartial(stance, covered_until, stance.end, *own.back());
    }
  }

  void lookAtContact(const FootContact& contact) {
    if (contact.is_shared) {
      addMissing(Foot::kUnknown,
                 contact.contact.strike,
                 contact.contact.toe_off,
                 "both feet stand on '" + contact.plate + "'");
    } else if (contact.foot == Foot::kUnknown && !contact.is_foreign) {
      addMissing(Foot::kUnknown,
                 contact.contact.strike,
                 contact.contact.toe_off,
                 "which foot stands on '" + contact.plate + "' cannot be told");
    }
  }

  /// Times in which no plate is loaded, in walking.
  void lookAtGaps(const TimeRange& record) {
    double loaded_until = record.start;
    const auto check_gap = [&](double until) {
      if (until - loaded_until > kEventMargin) {
        addMissing(
            Foot::kUnknown, loaded_until, until, "no plate is loaded although someone walks");
      }
    };
    for (const FootContact& contact : contacts_) {
      check_gap(contact.contact.strike);
      loaded_until = std::max(loaded_until, contact.contact.toe_off);
    }
    check_gap(record.end);
  }

  std::vector<MissingForce> take() {
    std::stable_sort(missing_.begin(), missing_.end(), [](const auto& a, const auto& b) {
      return a.range.start < b.range.start;
    });
    return std::move(missing_);
  }

 private:
  /// Contacts of the stance's foot at that time, by time; shared ones may be its own.
  std::vector<FootContact*> findContactsOf(const Stance& stance) {
    std::vector<FootContact*> own;
    for (FootContact& contact : contacts_) {
      // Which foot a force is said to act on changes nothing about where it was measured.
      const Foot foot = contact.isContradicted() ? contact.seen : contact.foot;
      const bool fits = foot == stance.foot || contact.is_shared;
      const double overlap = std::min(contact.contact.toe_off, stance.end) -
                             std::max(contact.contact.strike, stance.start);
      if (fits && overlap > 0) {
        own.push_back(&contact);
      }
    }
    // Both feet on a plate at the edge of another stance say nothing of this foot alone.
    const bool only_shared = std::all_of(
        own.begin(), own.end(), [](const FootContact* contact) { return contact->is_shared; });
    const bool long_enough =
        !own.empty() && own.back()->contact.toe_off - own.front()->contact.strike >
                            0.5 * (stance.end - stance.start);
    return only_shared && !long_enough ? std::vector<FootContact*>{} : own;
  }

  void addPartial(const Stance& stance, double start, double end, FootContact& contact) {
    addMissing(stance.foot, start, end, "stands partly without a force");
    if (!contact.is_shared && !contact.is_partial) {
      contact.is_partial = true;
      addMissing(stance.foot,
                 contact.contact.strike,
                 contact.contact.toe_off,
                 "stands partly beside '" + contact.plate + "'");
    }
  }

  void addMissing(Foot foot, double start, double end, const std::string& reason) {
    const std::string who =
        foot == Foot::kUnknown ? "" : std::string("the ") + footName(foot) + " foot ";
    missing_.push_back({foot, {start, end}, who + reason + " (" + formatRange(start, end) + ")"});
  }

  std::vector<FootContact>& contacts_;
  std::vector<MissingForce> missing_;
};

std::vector<TimeRange> findRest(const TimeRange& record, const std::vector<MissingForce>& missing) {
  std::vector<TimeRange> rest;
  double free_from = record.start;
  const auto add = [&](double until) {
    if (until - free_from >= kLeastInterval) {
      rest.push_back({free_from, until});
    }
  };
  for (const MissingForce& one : missing) {
    add(std::min(record.end, one.range.start - kEventMargin));
    free_from = std::max(free_from, one.range.end + kEventMargin);
  }
  add(record.end);
  return rest;
}

}  // namespace

ForceCoverage findForceCoverage(const std::vector<Stance>& stances,
                                GaitKind kind,
                                const TimeRange& record,
                                std::vector<FootContact>& contacts) {
  CoverageSearch search(contacts);
  for (const Stance& stance : stances) {
    if (stance.end > record.start && stance.start < record.end) {
      search.lookAtStance(stance);
    }
  }
  for (const FootContact& contact : contacts) {
    search.lookAtContact(contact);
  }
  if (stances.empty() && kind == GaitKind::kWalking) {
    search.lookAtGaps(record);
  }
  ForceCoverage coverage;
  coverage.missing = search.take();
  coverage.complete = findRest(record, coverage.missing);
  return coverage;
}

}  // namespace gaitmill
