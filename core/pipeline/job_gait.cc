#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/ground_reaction_table.h"
#include "core/base/error.h"
#include "core/math/events.h"
#include "core/pipeline/gait_reading.h"
#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

// Force plates sample at 1 to 2 kHz; curves and contacts lose nothing at 1 kHz.
constexpr double kLeastForceStep = 0.001;  // [s]

/// One per force, by the body it acts on.
std::vector<Foot> findFeet(const GroundReaction& reaction, const PipelineSettings& settings) {
  std::vector<Foot> feet;
  for (const ExternalForce& force : reaction.forces) {
    const GrfOptions& reading = settings.forces.reading;
    feet.push_back(force.body == reading.right_body  ? Foot::kRight
                   : force.body == reading.left_body ? Foot::kLeft
                                                     : Foot::kUnknown);
  }
  return feet;
}

/// Plates that the settings assign to something else than a foot act on it all the time.
std::pair<GroundReaction, GroundReaction> divideByBody(const GroundReaction& plates,
                                                       const std::vector<Foot>& feet) {
  GroundReaction of_feet;
  GroundReaction of_others;
  of_feet.time = of_others.time = plates.time;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const bool other = feet[i] == Foot::kUnknown && !plates.forces[i].body.empty();
    (other ? of_others : of_feet).forces.push_back(plates.forces[i]);
  }
  return {of_feet, of_others};
}

bool isStated(const TimeRange& range) {
  return std::isfinite(range.start) || std::isfinite(range.end);
}

bool isRraStated(const RraSettings& rra) {
  return isStated(rra.range) ||
         std::any_of(rra.passes.begin(), rra.passes.end(), [](const RraSettings::Pass& pass) {
           return pass.range && isStated(*pass.range);
         });
}

/// From the first to the last instant that a stage behind residual reduction is asked for.
std::optional<TimeRange> findStatedHull(const PipelineSettings& settings) {
  std::optional<TimeRange> hull;
  for (const TimeRange& range : {TimeRange{settings.id.start_time, settings.id.end_time},
                                 settings.so.range,
                                 settings.cmc_range}) {
    if (isStated(range)) {
      hull = hull ? TimeRange{std::min(hull->start, range.start), std::max(hull->end, range.end)}
                  : range;
    }
  }
  return hull;
}

}  // namespace

void takeFeet(const GroundReaction& plates, Job& job) {
  const PipelineSettings& settings = job.settings;
  auto [of_feet, of_others] = divideByBody(plates, findFeet(plates, settings));
  const std::vector<Foot> named = findFeet(of_feet, settings);
  job.gait = describeGait(of_feet,
                          named,
                          job.markers,
                          findGaitMarkersByLandmark(job.markers.names),
                          {settings.contacts, settings.cycle, settings.gait_cycle});
  for (const std::string& warning : job.gait.warnings) {
    job.warn(warning);
  }
  addGaitDecisions(job.gait, named, of_feet, job.decisions);
  job.reaction = assignForces(of_feet,
                              named,
                              job.gait.contacts,
                              settings.forces.reading.right_body,
                              settings.forces.reading.left_body);
  for (ExternalForce& force : of_others.forces) {
    job.reaction.forces.push_back(std::move(force));
  }
  require(plates.forces.empty() || !job.reaction.forces.empty(),
          ErrorCode::kGrfColumns,
          "no contact of '" + (plates.forces.empty() ? "" : plates.forces.front().name) +
              "' or another plate can be given to a foot; state the feet in trial.plates or "
              "trial.contacts",
          {{}, 0, 0, "trial.plates"});
}

TimeRange findDefaultRange(Stage stage, const Job& job) {
  const bool follows = stage > Stage::kRra && job.settings.runs(Stage::kRra);
  if (follows && isRraStated(job.settings.rra)) {
    return {};
  }
  if (const std::optional<TimeRange> hull = findStatedHull(job.settings)) {
    return {hull->start, hull->end + kLeadOut};
  }
  return job.gait.window ? job.gait.window->range : TimeRange{};
}

std::optional<GaitCycle> findGaitCycle(const Job& job) {
  if (job.settings.gait_cycle) {
    return GaitCycle{job.settings.gait_cycle->start, job.settings.gait_cycle->end};
  }
  if (job.gait.window && job.gait.window->cycle) {
    return job.gait.window->cycle->cycle;
  }
  if (job.gait.cycles.empty()) {
    return std::nullopt;
  }
  return job.gait.cycles.front().cycle;
}

std::vector<GaitCycle> findGaitCycles(const Job& job, Foot foot) {
  std::vector<GaitCycle> cycles;
  for (const NumberedCycle& numbered : job.gait.cycles) {
    const GaitCycle& cycle = numbered.cycle;
    const std::vector<double>& time = job.measured_coordinates.time;
    const bool covered = !time.empty() && cycle.start >= time.front() && cycle.end <= time.back();
    if (covered && numbered.foot == foot) {
      cycles.push_back(cycle);
    }
  }
  return cycles;
}

TimeSeries makeGroundReactions(const Job& job) {
  const std::vector<double>& time = job.measured_coordinates.time;
  return makeGroundReactionTable(job.reaction,
                                 findFeet(job.reaction, job.settings),
                                 time.front(),
                                 time.back(),
                                 kLeastForceStep);
}

TimeSeries makeMeasuredMarkers(const Job& job) {
  const IkResult& ik = *job.ik;
  TimeSeries table = makeTimeSeries("measured_markers", {}, ik.coordinates.time);
  std::vector<int> markers;
  for (const std::string& marker : ik.marker_errors.labels) {
    if (const std::optional<int> found = job.markers.findMarker(marker)) {
      markers.push_back(*found);
      for (const char* axis : {"_x", "_y", "_z"}) {
        table.labels.push_back(marker + axis);
        table.units.emplace_back("m");
      }
    }
  }
  table.values.resize(table.rowCount(), table.columnCount());
  const auto first =
      std::lower_bound(job.markers.time.begin(), job.markers.time.end(), table.time.front() - 1e-9);
  const auto start = static_cast<int>(first - job.markers.time.begin());
  for (int row = 0; row < table.rowCount(); ++row) {
    for (std::size_t i = 0; i < markers.size(); ++i) {
      table.values.row(row).segment<3>(static_cast<Eigen::Index>(3 * i)) =
          job.markers.position(start + row, markers[i]).transpose();
    }
  }
  return table;
}

}  // namespace gaitmill
