#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/report/report_parts.h"

namespace gaitmill {

namespace {

constexpr double kMillimetres = 1000;  // per metre

Html renderNumber(const Json& object, const char* name, double scale = 1) {
  return renderFigure(findNumber(object, {name}), scale);
}

Html renderIfAny(const HtmlTable& table) {
  return table.empty() ? Html() : table.render();
}

// Bodies that share their factors share a row.
Html renderScaleFactors(const Json& summary) {
  std::vector<std::pair<Json, std::string>> groups;
  for (const auto& [body, factors] : findMember(summary, {"scale", "factors"}).items()) {
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&, &wanted = factors](const auto& group) {
          return group.first == wanted;
        });
    if (known == groups.end()) {
      groups.emplace_back(factors, body);
    } else {
      known->second += ", " + body;
    }
  }
  HtmlTable table("Scale factors along the axes of each body",
                  {{"Bodies"}, {"Forward", true}, {"Up", true}, {"Right", true}});
  for (const auto& [factors, bodies] : groups) {
    std::vector<Html> cells = {text(bodies)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells.push_back(
          renderFigure(factors.is_array() && axis < factors.size() && factors[axis].is_number()
                           ? factors[axis].get<double>()
                           : std::nan("")));
    }
    table.addRow(cells);
  }
  return renderIfAny(table);
}

Html renderPlacements(const Json& summary) {
  HtmlTable table("Fit of the static poses, before the markers were moved onto them",
                  {{"Pose"}, {"RMS in mm", true}, {"Largest in mm", true}, {"Worst marker"}});
  int pose = 0;
  for (const Json& placement : findMember(summary, {"scale", "placements"})) {
    table.addRow({text(std::to_string(++pose)),
                  renderNumber(placement, "rms_m", kMillimetres),
                  renderNumber(placement, "max_error_m", kMillimetres),
                  text(findWords(placement, {"worst_marker"}))});
  }
  return renderIfAny(table);
}

Html renderMarkers(const Json& summary) {
  std::vector<std::pair<std::string, Json>> markers;
  for (const auto& [name, marker] : findMember(summary, {"quality", "marker_errors"}).items()) {
    markers.emplace_back(name, marker);
  }
  std::stable_sort(markers.begin(), markers.end(), [](const auto& a, const auto& b) {
    return findNumber(a.second, {"rms_m"}) > findNumber(b.second, {"rms_m"});
  });
  HtmlTable table("Distance of each marker from its measurement, worst first",
                  {{"Marker"},
                   {"Weight", true},
                   {"Mean in mm", true},
                   {"RMS in mm", true},
                   {"Largest in mm", true},
                   {"in frame", true},
                   {"at s", true},
                   {"Seen in % of the frames", true}});
  for (const auto& [name, marker] : markers) {
    const double frame = findNumber(marker, {"max_frame"});
    table.addRow(
        {text(name),
         renderNumber(marker, "weight"),
         renderNumber(marker, "mean_m", kMillimetres),
         renderNumber(marker, "rms_m", kMillimetres),
         renderNumber(marker, "max_m", kMillimetres),
         frame >= 0 ? text(std::to_string(static_cast<long>(frame))) : renderFigure(-frame),
         renderNumber(marker, "max_time_s"),
         renderNumber(marker, "visible_percent")});
  }
  return renderIfAny(table);
}

/// Three components, "1.2 / 0.4 / 0.1".
Html renderComponents(const Json& components) {
  Html shown;
  for (const Json& component : components) {
    shown += text(shown.empty() ? "" : " / ") +
             renderFigure(component.is_number() ? component.get<double>() : std::nan(""));
  }
  return shown;
}

/// A quantity of each pass, given by where it stands in the pass.
struct PassRow {
  const char* title;
  std::vector<std::string> path;
  double scale = 1;
};

Html renderMember(const Json& member, double scale) {
  return member.is_array()
             ? renderComponents(member)
             : renderFigure(member.is_number() ? member.get<double>() : std::nan(""), scale);
}

// Passes stand side by side: there are few, and what they say of each is much.
Html renderPasses(const Json& summary) {
  static const std::vector<PassRow> rows = {
      {"Body mass before, kg", {"mass_before_kg"}},
      {"Change of mass, kg", {"mass_change_kg"}},
      {"Shift of the mass centre forward, mm", {"center_shift_x_m"}, -kMillimetres},
      {"Shift of the mass centre to the right, mm", {"center_shift_z_m"}, -kMillimetres},
      {"Mean residual force before, N", {"average_residuals_before", "force_n"}},
      {"Mean residual force after the shift, N", {"average_residuals_after", "force_n"}},
      {"Mean residual moment before, N\u00b7m", {"average_residuals_before", "moment_nm"}},
      {"Mean residual moment after the shift, N\u00b7m", {"average_residuals_after", "moment_nm"}},
      {"Peak residual force, N", {"peak_residuals", "force_n"}},
      {"RMS residual force, N", {"rms_residuals", "force_n"}},
      {"Peak residual moment, N\u00b7m", {"peak_residuals", "moment_nm"}},
      {"RMS residual moment, N\u00b7m", {"rms_residuals", "moment_nm"}},
      {"Largest rotation from the measured motion, \u00b0", {"tracking", "max_deg"}},
      {"Largest RMS rotation, \u00b0", {"tracking", "max_rms_deg"}},
      {"Largest translation, cm", {"tracking", "max_cm"}},
      {"Largest RMS translation, cm", {"tracking", "max_rms_cm"}},
      {"Sum of what exceeds the limits", {"merit"}},
      {"Weights changed before", {"weights_changed"}}};
  const Json& passes = findMember(summary, {"rra_passes"});
  if (passes.empty()) {
    return {};
  }
  std::vector<TableColumn> columns = {{"Residuals along x (forward), y (up), z (right)"}};
  for (std::size_t pass = 1; pass <= passes.size(); ++pass) {
    columns.push_back({"Pass " + std::to_string(pass), true});
  }
  HtmlTable table("Passes of residual reduction", columns);
  for (const PassRow& row : rows) {
    std::vector<Html> cells = {text(row.title)};
    for (const Json& pass : passes) {
      cells.push_back(renderMember(findMember(pass, row.path), row.scale));
    }
    table.addRow(cells);
  }
  return table.render();
}

/// Peaks and RMS of actuators whose statistics are named peak_n and rms_n, or peak_nm and rms_nm.
Html renderActuators(const std::string& caption, const Json& actuators) {
  HtmlTable table(caption, {{"Actuator"}, {"Peak", true}, {"RMS", true}, {"Unit"}});
  for (const auto& [name, actuator] : actuators.items()) {
    const bool is_force = actuator.contains("peak_n");
    table.addRow({text(name),
                  renderNumber(actuator, is_force ? "peak_n" : "peak_nm"),
                  renderNumber(actuator, is_force ? "rms_n" : "rms_nm"),
                  text(is_force ? "N" : "N\u00b7m")});
  }
  return renderIfAny(table);
}

Html renderJointReserves(const Json& joints) {
  HtmlTable table("Largest reserve of each joint against the joint\u2019s largest moment",
                  {{"Joint"},
                   {"Reserve"},
                   {"Peak in N\u00b7m", true},
                   {"Moment of the joint in N\u00b7m", true},
                   {"Share in %", true}});
  for (const auto& [joint, reserve] : joints.items()) {
    table.addRow({text(joint),
                  text(findWords(reserve, {"actuator"})),
                  renderNumber(reserve, "peak_nm"),
                  renderNumber(reserve, "joint_moment_nm"),
                  renderNumber(reserve, "percent_of_joint_moment")});
  }
  return renderIfAny(table);
}

Html renderMoments(const Json& summary) {
  HtmlTable table("Moments of the muscles against inverse dynamics, over the gait cycle",
                  {{"Coordinate"},
                   {"RMS difference in N\u00b7m", true},
                   {"in % of the peak", true},
                   {"Largest difference in N\u00b7m", true},
                   {"in % of the peak", true},
                   {"Instants with at least 90 % from muscles, in %", true}});
  for (const auto& [coordinate, moment] : findMember(summary, {"quality", "moments"}).items()) {
    if (moment.is_object()) {
      table.addRow({text(coordinate),
                    renderNumber(moment, "rmse_nm"),
                    renderNumber(moment, "rmse_percent_of_peak"),
                    renderNumber(moment, "peak_difference_nm"),
                    renderNumber(moment, "peak_difference_percent_of_peak"),
                    renderNumber(moment, "fraction_of_instants_at_90_percent", 100)});
    }
  }
  return renderIfAny(table);
}

Html renderFibers(const Json& summary) {
  HtmlTable table("Muscles whose fibers leave 0.5 to 1.5 optimal lengths",
                  {{"Muscle"},
                   {"Shortest in optimal lengths", true},
                   {"Longest in optimal lengths", true},
                   {"Active force over time given out there, in %", true}});
  for (const auto& [muscle, range] :
       findMember(summary, {"quality", "fibers_out_of_range"}).items()) {
    table.addRow({text(muscle),
                  renderNumber(range, "shortest_optimal_lengths"),
                  renderNumber(range, "longest_optimal_lengths"),
                  renderNumber(range, "percent_of_its_active_impulse_outside")});
  }
  return renderIfAny(table);
}

/// Who changed the body's energy.
Html renderWork(const Json& summary) {
  static const std::vector<std::pair<const char*, const char*>> rows = {
      {"muscles_j", "Muscles"},
      {"actuators_j", "Torque actuators and reserves"},
      {"residuals_j", "Residuals at the pelvis"},
      {"ground_reactions_j", "Ground reactions"},
      {"energy_change_j", "Change of kinetic and potential energy"},
      {"imbalance_j", "Not accounted for"}};
  const Json& work = findMember(summary, {"work"});
  if (!work.is_object()) {
    return {};
  }
  HtmlTable table("Work over the gait cycle, or over what was analysed of it",
                  {{"By"}, {"Work in J", true}});
  for (const auto& [name, title] : rows) {
    table.addRow({text(title), renderNumber(work, name)});
  }
  return table.render();
}

std::string joinWords(const Json& words) {
  std::string joined;
  for (const Json& word : words) {
    joined += (joined.empty() ? "" : ", ") + (word.is_string() ? word.get<std::string>() : "");
  }
  return joined;
}

Html renderMuscleControl(const Json& summary) {
  const Json& quality = findMember(summary, {"quality"});
  return renderMoments(summary) +
         renderActuators("Residuals at the pelvis", findMember(quality, {"residuals"})) +
         renderJointReserves(findMember(quality, {"joint_reserves"})) +
         renderActuators("Reserves", findMember(quality, {"reserves"})) + renderFibers(summary) +
         renderWork(summary);
}

Html renderStaticOptimization(const Json& summary) {
  const Json& quality = findMember(summary, {"quality"});
  return renderJointReserves(findMember(quality, {"so_joint_reserves"})) +
         renderActuators("Reserves", findMember(quality, {"so_reserves"}));
}

}  // namespace

Html renderStageTables(const std::string& stage, const Json& summary) {
  if (stage == "scale") {
    return renderPlacements(summary) + renderScaleFactors(summary);
  }
  if (stage == "ik") {
    return renderMarkers(summary);
  }
  if (stage == "rra") {
    return renderPasses(summary) +
           renderActuators("Residuals of the last pass",
                           findMember(summary, {"quality", "rra_residuals"}));
  }
  if (stage == "so") {
    return renderStaticOptimization(summary);
  }
  return stage == "cmc" ? renderMuscleControl(summary) : Html();
}

Html renderEmg(const Json& summary) {
  HtmlTable table("Times of activity, measured and simulated",
                  {{"Channel"},
                   {"Muscles"},
                   {"Side"},
                   {"Both on or both off, % of the cycle", true},
                   {"Onset later by, % of the cycle", true},
                   {"End later by, % of the cycle", true},
                   {"Largest correlation", true},
                   {"at a lag of, % of the cycle", true}});
  for (const Json& channel : findMember(summary, {"emg", "comparison"})) {
    table.addRow({text(findWords(channel, {"channel"})),
                  text(joinWords(findMember(channel, {"muscles"}))),
                  text(findWords(channel, {"side"})),
                  renderNumber(channel, "overlap", 100),
                  renderNumber(channel, "onset_difference_percent"),
                  renderNumber(channel, "offset_difference_percent"),
                  renderNumber(channel, "correlation"),
                  renderNumber(channel, "lag_percent")});
  }
  if (table.empty()) {
    return {};
  }
  return element("section",
                 {{"id", "emg"}},
                 element("h2", "Comparison with EMG") + table.render() +
                     element("p",
                             "A muscle counts as on above 20 % of its peak. Positive differences "
                             "and lags mean that the simulation is later than the measurement; an "
                             "electromechanical delay is part of them. Amplitudes of surface EMG "
                             "are arbitrary and are not compared."));
}

}  // namespace gaitmill
