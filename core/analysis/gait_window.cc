#include "core/analysis/gait_window.h"

#include <algorithm>
#include <functional>

#include "core/analysis/foot_contacts.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

constexpr double kTimeSlack = 1e-9;  // [s]

bool covers(const TimeRange& outer, const TimeRange& inner) {
  return outer.start <= inner.start + kTimeSlack && inner.end <= outer.end + kTimeSlack;
}

bool isCovered(const std::vector<TimeRange>& complete, const TimeRange& range) {
  return std::any_of(complete.begin(), complete.end(), [&](const TimeRange& interval) {
    return covers(interval, range);
  });
}

TimeRange intersect(const TimeRange& a, const TimeRange& b) {
  return {std::max(a.start, b.start), std::min(a.end, b.end)};
}

std::string nameCycle(const NumberedCycle& cycle) {
  return std::string(footName(cycle.foot)) + " cycle " + std::to_string(cycle.number) + " (" +
         formatFixed(cycle.cycle.start, 3) + " to " + formatFixed(cycle.cycle.end, 3) + " s)";
}

TimeRange addMargins(const GaitCycle& cycle) {
  return {cycle.start - kLeadIn, cycle.end + kLeadOut};
}

using Window = std::optional<SimulatedWindow>;

Window takeWhole(const NumberedCycle& cycle,
                 const std::vector<TimeRange>& complete,
                 const TimeRange& record) {
  const TimeRange range = addMargins(cycle.cycle);
  if (!covers(record, range) || !isCovered(complete, range)) {
    return std::nullopt;
  }
  return SimulatedWindow{range, cycle, false, nameCycle(cycle) + " has complete forces", ""};
}

Window takeRealigned(const NumberedCycle& cycle,
                     const std::vector<TimeRange>& complete,
                     const TimeRange& record) {
  const double duration = cycle.cycle.end - cycle.cycle.start;
  for (const TimeRange& interval : complete) {
    const TimeRange usable = intersect(interval, record);
    const double first = std::max(usable.start + kLeadIn, cycle.cycle.start);
    const bool starts_inside = first < cycle.cycle.end;
    if (starts_inside && first + duration + kLeadOut <= usable.end) {
      const double percent = 100 * (first - cycle.cycle.start) / duration;
      return SimulatedWindow{{first - kLeadIn, first + duration + kLeadOut},
                             cycle,
                             true,
                             "forces are complete from " + formatFixed(percent, 0) + " % of " +
                                 nameCycle(cycle) + " to the same point of the next one",
                             ""};
    }
  }
  return std::nullopt;
}

Window takeShort(const NumberedCycle& cycle,
                 const std::vector<TimeRange>& complete,
                 const TimeRange& record) {
  if (!covers(record, {cycle.cycle.start, cycle.cycle.end})) {
    return std::nullopt;
  }
  for (const TimeRange& interval : complete) {
    if (covers(interval, {cycle.cycle.start, cycle.cycle.end})) {
      const TimeRange range = intersect(addMargins(cycle.cycle), intersect(interval, record));
      return SimulatedWindow{range,
                             cycle,
                             false,
                             nameCycle(cycle) + " has complete forces",
                             "less than 100 ms before " + nameCycle(cycle) +
                                 " can be simulated; its first percents contain the start-up"};
    }
  }
  return std::nullopt;
}

Window takeLongest(const std::vector<TimeRange>& complete, const TimeRange& record) {
  Window best;
  for (const TimeRange& interval : complete) {
    const TimeRange range = intersect(interval, record);
    if (range.end > range.start &&
        (!best || range.end - range.start > best->range.end - best->range.start)) {
      best = SimulatedWindow{range, std::nullopt, false, "", ""};
    }
  }
  if (best) {
    best->reason = "the longest interval with complete forces";
    best->warning =
        "there is no gait cycle with complete forces; the longest interval with "
        "complete forces is simulated: " +
        formatFixed(best->range.start, 3) + " to " + formatFixed(best->range.end, 3) + " s";
  }
  return best;
}

SimulatedWindow takeAnyway(const NumberedCycle& cycle, const TimeRange& record) {
  return {intersect(addMargins(cycle.cycle), record),
          cycle,
          false,
          nameCycle(cycle) + " was asked for",
          "forces are not complete during " + nameCycle(cycle) + ", which was asked for"};
}

}  // namespace

std::vector<NumberedCycle> listCycles(const std::vector<GaitEvent>& events,
                                      const std::vector<TimeRange>& complete) {
  std::vector<NumberedCycle> cycles;
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    int number = 0;
    for (const GaitCycle& cycle : findGaitCycles(events, foot)) {
      NumberedCycle numbered{foot, ++number, cycle};
      numbered.has_complete_forces = isCovered(complete, {cycle.start, cycle.end});
      const bool from_markers =
          std::any_of(events.begin(), events.end(), [&](const GaitEvent& event) {
            return event.foot == foot && event.source == GaitEvent::Source::kMarkers &&
                   (event.time == cycle.start || event.time == cycle.end);
          });
      numbered.source = from_markers ? GaitEvent::Source::kMarkers : GaitEvent::Source::kForces;
      cycles.push_back(numbered);
    }
  }
  return cycles;
}

SimulatedWindow findWindowOfCycle(const NumberedCycle& cycle,
                                  const std::vector<TimeRange>& complete,
                                  const TimeRange& record) {
  for (const auto& take : {takeWhole, takeRealigned, takeShort}) {
    if (const Window window = take(cycle, complete, record)) {
      return *window;
    }
  }
  return takeAnyway(cycle, record);
}

std::optional<SimulatedWindow> findWindow(const std::vector<NumberedCycle>& cycles,
                                          const std::vector<TimeRange>& complete,
                                          const TimeRange& record,
                                          const std::optional<CycleChoice>& chosen) {
  if (chosen) {
    const auto found = std::find_if(cycles.begin(), cycles.end(), [&](const NumberedCycle& one) {
      return one.foot == chosen->foot && one.number == chosen->number;
    });
    const auto count = std::count_if(cycles.begin(), cycles.end(), [&](const NumberedCycle& one) {
      return one.foot == chosen->foot;
    });
    require(found != cycles.end(),
            ErrorCode::kSettingsValue,
            "there is no " + std::string(footName(chosen->foot)) + " cycle " +
                std::to_string(chosen->number) + "; the recording has " + std::to_string(count),
            {{}, 0, 0, "trial.cycle"});
    return findWindowOfCycle(*found, complete, record);
  }
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    for (const auto& take : {takeWhole, takeRealigned, takeShort}) {
      for (const NumberedCycle& cycle : cycles) {
        if (cycle.foot != foot) {
          continue;
        }
        if (const Window window = take(cycle, complete, record)) {
          return window;
        }
      }
    }
  }
  return takeLongest(complete, record);
}

}  // namespace gaitmill
