#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/report/json_access.h"
#include "core/report/report.h"

namespace gaitmill {

namespace {

struct Range {
  double start = 0;  ///< [s]
  double end = 0;
  bool contains(double time) const { return time >= start && time <= end; }
};

std::optional<Range> readRange(const Json& pair) {
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
    return std::nullopt;
  }
  return Range{pair[0].get<double>(), pair[1].get<double>()};
}

/// The cycle that the results are normalised to, else the first of the right foot.
std::optional<Range> findCycle(const Json& summary) {
  if (const auto cycle = readRange(findMember(summary, {"gait_cycle_s"}))) {
    return cycle;
  }
  const Json& right = findMember(summary, {"cycles", "right"});
  return right.is_array() && !right.empty() ? readRange(right[0]) : std::nullopt;
}

std::optional<double> findToeOff(const Json& summary, const Range& cycle) {
  for (const Json& event : findMember(summary, {"events"})) {
    const double time = findNumber(event, {"time_s"});
    if (findWords(event, {"kind"}) == "toe_off" && findWords(event, {"foot"}) == "right" &&
        time > cycle.start && time < cycle.end) {
      return time;
    }
  }
  return std::nullopt;
}

std::vector<ReportInstant> makeQuarters(const std::string& of, const Range& range) {
  std::vector<ReportInstant> instants;
  for (int quarter = 0; quarter < 4; ++quarter) {
    instants.push_back({std::to_string(25 * quarter) + " % of the " + of,
                        range.start + 0.25 * quarter * (range.end - range.start)});
  }
  return instants;
}

/// Movement that repeats itself: an instant that was not analysed is shown one cycle later or
/// earlier.
double moveInto(const Range& motion, const Range& cycle, double time) {
  const double length = cycle.end - cycle.start;
  for (const double moved : {time, time + length, time - length}) {
    if (motion.contains(moved)) {
      return moved;
    }
  }
  return time;
}

}  // namespace

std::vector<ReportInstant> findReportInstants(const ResultSource& results) {
  constexpr auto kTime = ResultSource::Axis::kTime;
  if (!results.has("kinematics", kTime) || results.table("kinematics", kTime).time.empty()) {
    return {};
  }
  const std::vector<double>& time = results.table("kinematics", kTime).time;
  const Range motion{time.front(), time.back()};
  const Json summary = Json::parse(results.summary());
  const std::optional<Range> cycle = findCycle(summary);
  if (!cycle) {
    return makeQuarters("motion", motion);
  }
  std::vector<ReportInstant> instants = makeQuarters("gait cycle", *cycle);
  if (const std::optional<double> toe_off = findToeOff(summary, *cycle)) {
    instants = {{"Right heel strike", cycle->start},
                {"Right mid-stance", 0.5 * (cycle->start + *toe_off)},
                {"Right toe-off", *toe_off},
                {"Right mid-swing", 0.5 * (*toe_off + cycle->end)}};
  }
  for (ReportInstant& instant : instants) {
    instant.time = moveInto(motion, *cycle, instant.time);
  }
  return instants;
}

}  // namespace gaitmill
