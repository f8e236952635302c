#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/foot_contacts.h"
#include "core/analysis/ground_reaction_table.h"
#include "core/math/events.h"
#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

// Force plates sample at 1 to 2 kHz; curves and contacts lose nothing at 1 kHz.
constexpr double kLeastForceStep = 0.001;  // [s]

std::vector<Foot> findFeet(const Job& job) {
  std::vector<Foot> feet;
  for (const ExternalForce& force : job.reaction.forces) {
    const GrfOptions& reading = job.settings.forces.reading;
    feet.push_back(force.body == reading.right_body  ? Foot::kRight
                   : force.body == reading.left_body ? Foot::kLeft
                                                     : Foot::kUnknown);
  }
  return feet;
}

}  // namespace

std::optional<GaitCycle> findGaitCycle(const Job& job) {
  if (job.settings.gait_cycle) {
    return GaitCycle{job.settings.gait_cycle->start, job.settings.gait_cycle->end};
  }
  std::vector<double> strikes;
  for (const ExternalForce& force : job.reaction.forces) {
    if (force.body != job.settings.forces.reading.right_body) {
      continue;
    }
    for (const Contact& contact : findContacts(job.reaction.time, force.force.row(1).transpose())) {
      if (contact.has_strike) {
        strikes.push_back(contact.strike);
      }
    }
  }
  std::sort(strikes.begin(), strikes.end());
  if (strikes.size() < 2) {
    return std::nullopt;
  }
  return GaitCycle{strikes[0], strikes[1]};
}

std::vector<GaitEvent> findGaitEvents(const Job& job) {
  return findGaitEvents(
      findFootContacts(job.reaction,
                       findFeet(job),
                       makeGaitMotion(job.markers, findGaitMarkers(job.markers.names))));
}

std::vector<GaitCycle> findGaitCycles(const Job& job, Foot foot) {
  std::vector<GaitCycle> cycles;
  for (const GaitCycle& cycle : findGaitCycles(findGaitEvents(job), foot)) {
    const std::vector<double>& time = job.measured_coordinates.time;
    const bool covered = !time.empty() && cycle.start >= time.front() && cycle.end <= time.back();
    if (covered) {
      cycles.push_back(cycle);
    }
  }
  return cycles;
}

TimeSeries makeGroundReactions(const Job& job) {
  const std::vector<double>& time = job.measured_coordinates.time;
  return makeGroundReactionTable(
      job.reaction, findFeet(job), time.front(), time.back(), kLeastForceStep);
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
