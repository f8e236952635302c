#include "core/pipeline/settings.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"
#include "core/pipeline/json_fields.h"
#include "core/pipeline/settings_fields.h"

namespace gaitmill {

namespace {

constexpr Limits kPositiveForce{1e-6, 1e6};  // [N|N.m]
constexpr Limits kControlLimit{0, 1e12};
constexpr Limits kCutoff{0.1, 1000};  // [Hz]
constexpr Limits kUnit{0, 1};
constexpr Limits kPasses{0, 20};
constexpr Limits kEmgFrequency{0.1, 100000};  // [Hz]
constexpr Limits kFilterOrder{1, 12};

const Choices<SignedAxis>& axisChoices() {
  static const Choices<SignedAxis> choices = {{"x", {0, 1}},
                                              {"-x", {0, -1}},
                                              {"y", {1, 1}},
                                              {"-y", {1, -1}},
                                              {"z", {2, 1}},
                                              {"-z", {2, -1}}};
  return choices;
}

template <class Fields>
void visitStages(Fields& fields, PipelineSettings& settings) {
  fields.stage("first", settings.first);
  fields.stage("last", settings.last);
  fields.stages("skip", settings.skipped);
  if (settings.last < settings.first) {
    fields.refuse("last", "is a stage before the first one");
  }
}

/// How the files of a laboratory are to be read; null = as the data say.
template <class Fields>
void visitLaboratory(Fields& fields, PipelineSettings& settings) {
  static const Choices<double> kLengths = {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}};
  static const Choices<double> kMoments = {{"N.m", 1.0}, {"N.mm", 0.001}};
  static const Choices<bool> kDirections = {{"on_subject", true}, {"on_plate", false}};
  static const Choices<bool> kAngles = {{"deg", true}, {"rad", false}};
  fields.choice("vertical_axis", axisChoices(), settings.laboratory.vertical);
  fields.choice("forward_axis", axisChoices(), settings.laboratory.forward);
  fields.choice("marker_units", kLengths, settings.laboratory.metres_per_unit);
  fields.choice("force_vertical_axis", axisChoices(), settings.force_reading.vertical);
  fields.choice("force_forward_axis", axisChoices(), settings.force_reading.forward);
  fields.choice("force_point_units", kLengths, settings.force_reading.metres_per_unit);
  fields.choice("force_moment_units", kMoments, settings.force_reading.moment_factor);
  fields.choice("force_direction", kDirections, settings.force_reading.on_subject);
  fields.number("force_time_offset_s", {-10, 10}, settings.force_time_offset);
  fields.choice("angle_units", kAngles, settings.angles_in_degrees);
  fields.number("max_gap_s", {0, 10}, settings.marker_faults.max_gap);
}

/// Contacts whose feet are stated, and the cycle that is simulated.
template <class Fields>
void visitFeet(Fields& fields, PipelineSettings& settings) {
  static const Choices<Foot> kFeet = {{"right", Foot::kRight}, {"left", Foot::kLeft}};
  static const Choices<Foot> kFeetOrNone = {
      {"right", Foot::kRight}, {"left", Foot::kLeft}, {"none", Foot::kUnknown}};
  fields.list("contacts", settings.contacts, [](auto& inner, ContactStatement& contact) {
    inner.need("plate");
    inner.text("plate", contact.plate);
    inner.need("time_s");
    inner.number("time_s", {}, contact.time);
    inner.need("foot");
    inner.choice("foot", kFeetOrNone, contact.foot);
  });
  fields.object("cycle", settings.cycle, [](auto& inner, CycleChoice& cycle) {
    inner.choice("foot", kFeet, cycle.foot);
    inner.count("number", {1, 100000}, cycle.number);
  });
}

template <class Fields>
void visitTrial(Fields& fields, PipelineSettings& settings) {
  using Times = TrcOptions::Times;
  using Zeros = TrcOptions::Zeros;
  using Prefixes = TrcOptions::Prefixes;
  GrfOptions& reading = settings.forces.reading;
  fields.choice("marker_times",
                Choices<Times>{{"regular", Times::kRegular}, {"exact", Times::kExact}},
                settings.trc.times);
  fields.choice("marker_zeros",
                Choices<Zeros>{{"missing", Zeros::kMissing}, {"measured", Zeros::kMeasured}},
                settings.trc.zeros);
  fields.choice("marker_prefixes",
                Choices<Prefixes>{{"keep", Prefixes::kKeep}, {"strip", Prefixes::kStrip}},
                settings.trc.prefixes);
  fields.landmarks("marker_names", settings.marker_names);
  fields.number("force_threshold_n", {0, 500}, reading.threshold);
  fields.number("force_lowpass_cutoff_hz", kCutoff, settings.forces.lowpass_cutoff);
  fields.text("right_foot_body", reading.right_body);
  fields.text("left_foot_body", reading.left_body);
  fields.list("plates", reading.plates, [](auto& plate, PlateAssignment& assignment) {
    plate.need("family");
    plate.text("family", assignment.family);
    plate.need("body");
    plate.text("body", assignment.body);
  });
  visitLaboratory(fields, settings);
  fields.range("gait_cycle_s", settings.gait_cycle);
  visitFeet(fields, settings);
  fields.choice("paper_trial",
                Choices<PaperTrial>{{"walk", PaperTrial::kWalk}, {"run", PaperTrial::kRun}},
                settings.paper_trial);
}

template <class Fields>
void visitScale(Fields& fields, PipelineSettings& settings) {
  fields.text("marker_set", settings.marker_set);
  fields.choice("method",
                Choices<ScaleMethod>{{"auto", ScaleMethod::kAuto},
                                     {"static", ScaleMethod::kStatic},
                                     {"motion", ScaleMethod::kMotion}},
                settings.scale_method);
  fields.number("fiber_damping", {0, 10}, settings.fiber_damping);
}

template <class Fields>
void visitIk(Fields& fields, PipelineSettings& settings) {
  fields.range("time_range_s", settings.ik_range);
  fields.number("warn_rms_m", {0, 10}, settings.ik_warn_rms);
  fields.number("warn_max_m", {0, 10}, settings.ik_warn_max);
}

template <class Fields>
void visitOthers(Fields& fields, const char* listed, OtherCoordinates& others) {
  // Who lists coordinates means these.
  if (fields.isGiven(listed)) {
    others = OtherCoordinates::kNone;
  }
  fields.choice("other_coordinates",
                Choices<OtherCoordinates>{{"none", OtherCoordinates::kNone},
                                          {"muscles", OtherCoordinates::kMuscles},
                                          {"all", OtherCoordinates::kAll}},
                others);
}

template <class Fields>
void visitActuators(Fields& fields, ActuatorSetSettings& set) {
  using Residuals = ActuatorSetSettings::Residuals;
  fields.object("residuals", set.residuals, [](auto& inner, Residuals& residuals) {
    inner.text("body", residuals.body);
    inner.point("point_m", residuals.point);
    inner.number("optimal_force_n", kPositiveForce, residuals.optimal_force);
    inner.number("optimal_moment_nm", kPositiveForce, residuals.optimal_moment);
    inner.number("control_limit", kControlLimit, residuals.control_limit);
  });
  fields.values("coordinates", set.coordinates);
  visitOthers(fields, "coordinates", set.others);
  fields.number("other_optimal_force", kPositiveForce, set.other_optimal_force);
  fields.text("name_suffix", set.name_suffix);
  fields.number("control_limit", kControlLimit, set.control_limit);
}

template <class Fields>
void visitRra(Fields& fields, RraSettings& rra) {
  // Who lists passes wants them as they are, unless something else is said.
  if (fields.isGiven("passes")) {
    rra.strategy = RraStrategy::kPasses;
  }
  fields.choice("strategy",
                Choices<RraStrategy>{{"autopilot", RraStrategy::kAutopilot},
                                     {"passes", RraStrategy::kPasses}},
                rra.strategy);
  fields.numberOrAuto("lowpass_cutoff_hz", kCutoff, rra.lowpass_cutoff, rra.automatic_cutoff);
  fields.range("time_range_s", rra.range);
  fields.object("actuators", [&](auto& inner) { visitActuators(inner, rra.actuators); });
  fields.text("adjusted_body", rra.adjusted_body);
  fields.choice("inertia",
                Choices<InertiaScaling>{{"with_mass", InertiaScaling::kWithMass},
                                        {"keep", InertiaScaling::kKeep}},
                rra.inertia);
  fields.list("passes", rra.passes, [](auto& inner, RraSettings::Pass& pass) {
    inner.values("weights", pass.weights);
    visitOthers(inner, "weights", pass.others);
    inner.range("time_range_s", pass.range);
  });
  if (fields.isGiven("passes") && rra.strategy == RraStrategy::kPasses) {
    rra.max_passes = static_cast<int>(rra.passes.size());
  }
  fields.count("max_passes", {1, kPasses.high}, rra.max_passes);
  fields.number("mass_tolerance_kg", {0, 100}, rra.mass_tolerance);
  fields.number("center_tolerance_m", kUnit, rra.center_tolerance);
}

template <class Fields>
void visitStrength(Fields& fields, PipelineSettings& settings) {
  fields.choice("law",
                Choices<StrengthLaw>{{"none", StrengthLaw::kNone},
                                     {"as_intended", StrengthLaw::kAsIntended},
                                     {"as_published", StrengthLaw::kAsPublished}},
                settings.strength_law);
  fields.number("height_m", {0.5, 2.6}, settings.strength_height);
  fields.number("max_contraction_velocity", {1, 100}, settings.max_contraction_velocity);
}

template <class Fields>
void visitId(Fields& fields, PipelineSettings& settings) {
  fields.number("lowpass_cutoff_hz", kCutoff, settings.id.lowpass_cutoff);
  TimeRange range{settings.id.start_time, settings.id.end_time};
  fields.range("time_range_s", range);
  settings.id.start_time = range.start;
  settings.id.end_time = range.end;
  fields.count("rra_pass", kPasses, settings.id_pass);
}

template <class Fields>
void visitSo(Fields& fields, PipelineSettings& settings) {
  using Capacity = SoOptions::Capacity;
  using Passive = SoOptions::PassiveForce;
  fields.number("exponent", {1, 10}, settings.so.exponent);
  bool follows_fibers = settings.so.capacity == Capacity::kForceLengthVelocity;
  fields.flag("force_length_velocity", follows_fibers);
  settings.so.capacity = follows_fibers ? Capacity::kForceLengthVelocity : Capacity::kIsometric;
  bool passive = settings.so.passive_force == Passive::kOn;
  fields.flag("passive_force", passive);
  settings.so.passive_force = passive ? Passive::kOn : Passive::kOff;
  fields.range("time_range_s", settings.so.range);
  fields.number("row_interval_s", {0, 10}, settings.so_interval);
  fields.object("actuators", [&](auto& inner) { visitActuators(inner, settings.so_actuators); });
}

template <class Fields>
void visitExcitationLimit(Fields& fields, ExcitationLimit& limit) {
  fields.need("muscle");
  fields.text("muscle", limit.muscle);
  fields.list("nodes", limit.nodes, [](auto& inner, ExcitationLimit::Node& node) {
    inner.need("until_s");
    inner.number("until_s", {}, node.time);
    inner.number("upper", kUnit, node.upper);
  });
}

template <class Fields>
void visitCmc(Fields& fields, PipelineSettings& settings) {
  CmcOptions& cmc = settings.cmc;
  fields.range("time_range_s", settings.cmc_range);
  fields.number("window_s", {0.001, 0.1}, cmc.window);
  fields.number("position_gain", {0, 1e6}, cmc.position_gain);
  fields.number("velocity_gain", {0, 1e6}, cmc.velocity_gain);
  fields.number("min_excitation", kUnit, cmc.min_excitation);
  fields.number("max_excitation", kUnit, cmc.max_excitation);
  fields.flag("equilibrate_at_default_pose", cmc.equilibrate_at_default_pose);
  fields.number("integration_step_s", {1e-5, 0.1}, cmc.integration_step);
  fields.number("excitation_tolerance", {1e-12, 0.1}, cmc.excitation_tolerance);
  fields.number("barrier", kUnit, cmc.barrier);
  fields.choice("solver",
                Choices<CmcQpSolver>{{"dual", CmcQpSolver::kDual}, {"ipopt", CmcQpSolver::kIpopt}},
                cmc.qp_solver);
  fields.list("excitation_limits", cmc.excitation_limits, [](auto& inner, ExcitationLimit& limit) {
    visitExcitationLimit(inner, limit);
  });
  fields.object("actuators", [&](auto& inner) { visitActuators(inner, settings.cmc_actuators); });
}

template <class Fields>
void visitEmg(Fields& fields, EmgSettings& emg) {
  EmgOptions& processing = emg.processing;
  fields.choice(
      "source",
      Choices<EmgSource>{
          {"auto", EmgSource::kAuto}, {"raw", EmgSource::kRaw}, {"envelope", EmgSource::kEnvelope}},
      emg.source);
  fields.band("band_pass_hz", kEmgFrequency, processing.band_pass);
  fields.count("band_pass_order", kFilterOrder, processing.band_pass_order);
  fields.number("butterworth_hz", kEmgFrequency, processing.butterworth);
  fields.count("butterworth_order", kFilterOrder, processing.butterworth_order);
  fields.number("critically_damped_hz", kEmgFrequency, processing.critically_damped);
  fields.count("critically_damped_passes", {2, kPasses.high}, processing.critically_damped_passes);
  if (processing.critically_damped_passes % 2 != 0) {
    fields.refuse("critically_damped_passes", "expected an even number of passes");
  }
  fields.choice("ends",
                Choices<EdgeTreatment>{{"reflected", EdgeTreatment::kReflected},
                                       {"zero_start", EdgeTreatment::kZeroStart}},
                processing.ends);
  fields.number("electromechanical_delay_s", {0, 0.5}, emg.electromechanical_delay);
  fields.choice("side",
                Choices<BodySide>{{"right", BodySide::kRight}, {"left", BodySide::kLeft}},
                emg.mapping.side);
  fields.lists("channels", emg.mapping.channels);
}

template <class Fields>
void visitSettings(Fields& fields, PipelineSettings& settings) {
  fields.text("name", settings.name);
  fields.text("description", settings.description);
  fields.object("stages", [&](auto& inner) { visitStages(inner, settings); });
  fields.object("trial", [&](auto& inner) { visitTrial(inner, settings); });
  fields.object("scale", [&](auto& inner) { visitScale(inner, settings); });
  fields.object("ik", [&](auto& inner) { visitIk(inner, settings); });
  fields.object("rra", [&](auto& inner) { visitRra(inner, settings.rra); });
  fields.object("strength", [&](auto& inner) { visitStrength(inner, settings); });
  fields.object("id", [&](auto& inner) { visitId(inner, settings); });
  fields.object("so", [&](auto& inner) { visitSo(inner, settings); });
  fields.object("cmc", [&](auto& inner) { visitCmc(inner, settings); });
  fields.object("emg", [&](auto& inner) { visitEmg(inner, settings.emg); });
}

}  // namespace

bool PipelineSettings::runs(Stage stage) const {
  return stage >= first && stage <= last &&
         std::find(skipped.begin(), skipped.end(), stage) == skipped.end();
}

PipelineSettings readSettings(const InputFile& document) {
  const nlohmann::json json = parseJson(document);
  SettingsReader fields(JsonFields(json, "", document.name));
  PipelineSettings settings;
  visitSettings(fields, settings);
  fields.finish();
  return settings;
}

std::string writeSettings(PipelineSettings settings) {
  SettingsWriter fields;
  visitSettings(fields, settings);
  return fields.json().dump(2) + "\n";
}

}  // namespace gaitmill
