#pragma once

#include "core/cmc/cmc_result.h"
#include "core/id/id_result.h"
#include "core/ik/ik_result.h"
#include "core/pipeline/archive.h"
#include "core/rra/rra_result.h"
#include "core/scale/scale_result.h"
#include "core/so/so_result.h"

namespace gaitmill {

// How each struct that a stage leaves behind is taken apart. The structured bindings must name
// every field in order: one that is added later does not compile until it is saved, too.

template <class Archive>
void visitFields(Archive& archive, Access<Archive, TimeSeries>& value) {
  auto& [name, labels, units, time, values] = value;
  archive(name, labels, units, time, values);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, FunctionSpec>& value) {
  auto& [kind, x, y, scale] = value;
  archive(kind, x, y, scale);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, WrapObjectSpec>& value) {
  auto& [name, kind, rotation, translation, quadrant, radius, length, semi_axes, active] = value;
  archive(name, kind, rotation, translation, quadrant, radius, length, semi_axes, active);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MeshSpec>& value) {
  auto& [file, scale_factors, translation, orientation] = value;
  archive(file, scale_factors, translation, orientation);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, BodySpec>& value) {
  auto& [name, mass, mass_center, inertia, wrap_objects, meshes] = value;
  archive(name, mass, mass_center, inertia, wrap_objects, meshes);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, FrameSpec>& value) {
  auto& [body, translation, orientation] = value;
  archive(body, translation, orientation);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CoordinateSpec>& value) {
  auto& [name, default_value, default_speed, range_min, range_max, clamped, locked] = value;
  archive(name, default_value, default_speed, range_min, range_max, clamped, locked);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, TransformAxisSpec>& value) {
  auto& [coordinate, axis, function] = value;
  archive(coordinate, axis, function);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, JointSpec>& value) {
  auto& [name, kind, parent, child, coordinates, axes] = value;
  archive(name, kind, parent, child, coordinates, axes);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CouplerSpec>& value) {
  auto& [name, independent, dependent, function, scale, enforced] = value;
  archive(name, independent, dependent, function, scale, enforced);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MarkerSpec>& value) {
  auto& [name, body, location, fixed] = value;
  archive(name, body, location, fixed);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, PathPointSpec>& value) {
  auto& [body, location, kind, coordinate, range_min, range_max, location_functions] = value;
  archive(body, location, kind, coordinate, range_min, range_max, location_functions);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, PathWrapSpec>& value) {
  auto& [wrap_object, first_point, last_point, method] = value;
  archive(wrap_object, first_point, last_point, method);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MuscleCurvesSpec>& value) {
  auto& [active_min_length,
         active_transition_length,
         active_max_length,
         active_shallow_slope,
         active_minimum_value,
         concentric_slope_at_vmax,
         concentric_slope_near_vmax,
         isometric_slope,
         eccentric_slope_at_vmax,
         eccentric_slope_near_vmax,
         max_eccentric_force,
         concentric_curviness,
         eccentric_curviness,
         passive_strain_at_zero_force,
         passive_strain_at_one_force,
         passive_stiffness_at_low_force,
         passive_stiffness_at_one_force,
         passive_curviness,
         tendon_strain_at_one_force,
         tendon_stiffness_at_one_force,
         tendon_force_at_toe_end,
         tendon_curviness] = value;
  archive(active_min_length,
          active_transition_length,
          active_max_length,
          active_shallow_slope,
          active_minimum_value,
          concentric_slope_at_vmax,
          concentric_slope_near_vmax,
          isometric_slope,
          eccentric_slope_at_vmax,
          eccentric_slope_near_vmax,
          max_eccentric_force,
          concentric_curviness,
          eccentric_curviness,
          passive_strain_at_zero_force,
          passive_strain_at_one_force,
          passive_stiffness_at_low_force,
          passive_stiffness_at_one_force,
          passive_curviness,
          tendon_strain_at_one_force,
          tendon_stiffness_at_one_force,
          tendon_force_at_toe_end,
          tendon_curviness);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ThelenCurvesSpec>& value) {
  auto& [tendon_strain_at_one_force,
         passive_strain_at_one_force,
         active_shape,
         passive_shape,
         velocity_shape,
         max_eccentric_force,
         linear_above_force] = value;
  archive(tendon_strain_at_one_force,
          passive_strain_at_one_force,
          active_shape,
          passive_shape,
          velocity_shape,
          max_eccentric_force,
          linear_above_force);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, SchutteCurvesSpec>& value) {
  auto& [excitation_rate,
         activation_rate,
         active_force_length,
         passive_force_length,
         tendon_force_strain] = value;
  archive(excitation_rate,
          activation_rate,
          active_force_length,
          passive_force_length,
          tendon_force_strain);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MuscleSpec>& value) {
  auto& [name,
         max_isometric_force,
         optimal_fiber_length,
         tendon_slack_length,
         pennation_at_optimal,
         max_contraction_velocity,
         fiber_damping,
         activation_time_constant,
         deactivation_time_constant,
         minimum_activation,
         default_activation,
         default_fiber_length,
         maximum_pennation,
         min_control,
         max_control,
         tendon,
         curves,
         path,
         wraps,
         kind,
         thelen,
         schutte] = value;
  archive(name,
          max_isometric_force,
          optimal_fiber_length,
          tendon_slack_length,
          pennation_at_optimal,
          max_contraction_velocity,
          fiber_damping,
          activation_time_constant,
          deactivation_time_constant,
          minimum_activation,
          default_activation,
          default_fiber_length,
          maximum_pennation,
          min_control,
          max_control,
          tendon,
          curves,
          path,
          wraps,
          kind,
          thelen,
          schutte);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ActuatorSpec>& value) {
  auto& [name,
         kind,
         coordinate,
         body,
         reaction_body,
         point,
         direction,
         direction_in_ground,
         optimal_force,
         min_control,
         max_control] = value;
  archive(name,
          kind,
          coordinate,
          body,
          reaction_body,
          point,
          direction,
          direction_in_ground,
          optimal_force,
          min_control,
          max_control);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, PassiveForceSpec>& value) {
  auto& [name,
         kind,
         coordinate,
         upper_limit,
         lower_limit,
         upper_stiffness,
         lower_stiffness,
         damping,
         transition,
         stiffness,
         rest_length,
         viscosity,
         frame1,
         frame2,
         rotational_stiffness,
         translational_stiffness,
         rotational_damping,
         translational_damping,
         functions,
         expressions] = value;
  archive(name,
          kind,
          coordinate,
          upper_limit,
          lower_limit,
          upper_stiffness,
          lower_stiffness,
          damping,
          transition,
          stiffness,
          rest_length,
          viscosity,
          frame1,
          frame2,
          rotational_stiffness,
          translational_stiffness,
          rotational_damping,
          translational_damping,
          functions,
          expressions);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MuscleGroupSpec>& value) {
  auto& [name, members] = value;
  archive(name, members);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ModelSpec>& value) {
  auto& [name,
         credits,
         gravity,
         bodies,
         ground_wrap_objects,
         joints,
         couplers,
         markers,
         muscles,
         actuators,
         passive_forces,
         muscle_groups,
         document_version] = value;
  archive(name,
          credits,
          gravity,
          bodies,
          ground_wrap_objects,
          joints,
          couplers,
          markers,
          muscles,
          actuators,
          passive_forces,
          muscle_groups,
          document_version);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, BodyScale>& value) {
  auto& [body, factors] = value;
  archive(body, factors);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, PairResult>& value) {
  auto& [first, second, measured, in_model, visible_fraction, factor] = value;
  archive(first, second, measured, in_model, visible_fraction, factor);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MeasurementResult>& value) {
  auto& [name, factor, pairs, use] = value;
  archive(name, factor, pairs, use);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, PlacementResult>& value) {
  auto& [pose,
         markers,
         errors,
         rms,
         max_error,
         worst_marker,
         moved_markers,
         removed_markers,
         iterations,
         converged] = value;
  archive(pose,
          markers,
          errors,
          rms,
          max_error,
          worst_marker,
          moved_markers,
          removed_markers,
          iterations,
          converged);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, SizeEstimate>& value) {
  auto& [name, factor, expected, deviations, at_bound] = value;
  archive(name, factor, expected, deviations, at_bound);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, OffsetEstimate>& value) {
  auto& [marker, distance, deviations] = value;
  archive(marker, distance, deviations);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MotionFitResult>& value) {
  auto& [times,
         markers,
         sizes,
         offsets,
         moved_markers,
         removed_markers,
         frames_rms_before,
         frames_rms,
         motion_rms_before,
         motion_rms,
         iterations,
         converged] = value;
  archive(times,
          markers,
          sizes,
          offsets,
          moved_markers,
          removed_markers,
          frames_rms_before,
          frames_rms,
          motion_rms_before,
          motion_rms,
          iterations,
          converged);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ScaleResult>& value) {
  auto& [model, factors, measurements, placements, motion, mass, pose_rounds, warnings] = value;
  archive(model, factors, measurements, placements, motion, mass, pose_rounds, warnings);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, IkResult>& value) {
  auto& [coordinates,
         errors,
         marker_errors,
         worst_markers,
         visible_counts,
         iterations,
         markers,
         weights,
         unused_tasks,
         held_coordinates,
         observability,
         unconverged_frames,
         mean_rms,
         max_rms,
         max_error,
         worst_frame_time,
         max_error_marker,
         warnings] = value;
  archive(coordinates,
          errors,
          marker_errors,
          worst_markers,
          visible_counts,
          iterations,
          markers,
          weights,
          unused_tasks,
          held_coordinates,
          observability,
          unconverged_frames,
          mean_rms,
          max_rms,
          max_error,
          worst_frame_time,
          max_error_marker,
          warnings);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, TrackingTask>& value) {
  auto& [coordinate, weight, position_gain, velocity_gain] = value;
  archive(coordinate, weight, position_gain, velocity_gain);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraPassOptions>& value) {
  auto& [start_time, end_time, tasks] = value;
  archive(start_time, end_time, tasks);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraLimits>& value) {
  auto& [rotation_rms,
         rotation_peak,
         translation_rms,
         translation_peak,
         force_rms,
         force_peak,
         force_peak_share,
         moment_rms,
         moment_peak] = value;
  archive(rotation_rms,
          rotation_peak,
          translation_rms,
          translation_peak,
          force_rms,
          force_peak,
          force_peak_share,
          moment_rms,
          moment_peak);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraOptions>& value) {
  auto& [strategy,
         limits,
         max_mass_change,
         passes,
         max_passes,
         mass_tolerance,
         mass_center_tolerance,
         lowpass_cutoff,
         lowpass_reason,
         padding_rows,
         actuators,
         adjusted_body,
         max_mass_center_shift,
         adjust_mass_center,
         adjust_mass,
         inertia_scaling,
         window,
         integration_tolerance] = value;
  archive(strategy,
          limits,
          max_mass_change,
          passes,
          max_passes,
          mass_tolerance,
          mass_center_tolerance,
          lowpass_cutoff,
          lowpass_reason,
          padding_rows,
          actuators,
          adjusted_body,
          max_mass_center_shift,
          adjust_mass_center,
          adjust_mass,
          inertia_scaling,
          window,
          integration_tolerance);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ResidualSum>& value) {
  auto& [force, moment] = value;
  archive(force, moment);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ResidualStatistics>& value) {
  auto& [average, peak, rms] = value;
  archive(average, peak, rms);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, MassAdjustment>& value) {
  auto& [average_before,
         average_after,
         shift_x,
         shift_z,
         shift_limited,
         mass_before,
         mass_change,
         mass_after,
         mass_limited,
         desired] = value;
  archive(average_before,
          average_after,
          shift_x,
          shift_z,
          shift_limited,
          mass_before,
          mass_change,
          mass_after,
          mass_limited,
          desired);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, TrackingStatistics>& value) {
  auto& [max_deg, max_rms_deg, max_cm, max_rms_cm, worst_rotation, worst_translation] = value;
  archive(max_deg, max_rms_deg, max_cm, max_rms_cm, worst_rotation, worst_translation);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraCounters>& value) {
  auto& [windows, steps, rejected_steps, bounded_windows] = value;
  archive(windows, steps, rejected_steps, bounded_windows);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CoordinateDeviation>& value) {
  auto& [coordinate, translation, rms, peak, share] = value;
  archive(coordinate, translation, rms, peak, share);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, WeightChange>& value) {
  auto& [coordinate, before, after, reason] = value;
  archive(coordinate, before, after, reason);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraPassResult>& value) {
  auto& [used,
         from_pass,
         weight_changes,
         merit,
         decision,
         adjustment,
         tracking,
         deviations,
         residuals,
         counters,
         coordinates,
         speeds,
         actuator_forces,
         residual_sums,
         tracking_errors,
         adjusted_model] = value;
  archive(used,
          from_pass,
          weight_changes,
          merit,
          decision,
          adjustment,
          tracking,
          deviations,
          residuals,
          counters,
          coordinates,
          speeds,
          actuator_forces,
          residual_sums,
          tracking_errors,
          adjusted_model);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, RraResult>& value) {
  auto& [passes, converged, options, kept, mass_steps, warnings] = value;
  archive(passes, converged, options, kept, mass_steps, warnings);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, IdResult>& value) {
  auto& [generalized_forces, coordinates, speeds, accelerations, residual_wrench, lowpass_cutoff] =
      value;
  archive(generalized_forces, coordinates, speeds, accelerations, residual_wrench, lowpass_cutoff);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, InfeasibleRow>& value) {
  auto& [time, coordinate, missing] = value;
  archive(time, coordinate, missing);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, SoResult>& value) {
  auto& [activations,
         forces,
         demand,
         pose,
         speed,
         muscle_count,
         infeasible_rows,
         iterations,
         peak_actuator_forces,
         warnings] = value;
  archive(activations,
          forces,
          demand,
          pose,
          speed,
          muscle_count,
          infeasible_rows,
          iterations,
          peak_actuator_forces,
          warnings);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ExcitationLimit::Node>& value) {
  auto& [time, upper] = value;
  archive(time, upper);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, ExcitationLimit>& value) {
  auto& [muscle, nodes] = value;
  archive(muscle, nodes);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CmcOptions>& value) {
  auto& [start_time,
         end_time,
         window,
         initial_window,
         hold_duration,
         hold_excitation,
         position_gain,
         velocity_gain,
         min_excitation,
         max_excitation,
         excitation_limits,
         actuators,
         torque_control_limit,
         equilibrate_at_default_pose,
         uncontrollable_range,
         excitation_tolerance,
         fiber_tolerance,
         integration_step,
         qp_solver,
         barrier] = value;
  archive(start_time,
          end_time,
          window,
          initial_window,
          hold_duration,
          hold_excitation,
          position_gain,
          velocity_gain,
          min_excitation,
          max_excitation,
          excitation_limits,
          actuators,
          torque_control_limit,
          equilibrate_at_default_pose,
          uncontrollable_range,
          excitation_tolerance,
          fiber_tolerance,
          integration_step,
          qp_solver,
          barrier);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, InfeasibleWindow::Missing>& value) {
  auto& [coordinate, force] = value;
  archive(coordinate, force);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, InfeasibleWindow>& value) {
  auto& [time, missing] = value;
  archive(time, missing);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CmcCounters>& value) {
  auto& [windows, qp_iterations, predictions, fiber_steps, rejected_steps, path_evaluations] =
      value;
  archive(windows, qp_iterations, predictions, fiber_steps, rejected_steps, path_evaluations);
}

template <class Archive>
void visitFields(Archive& archive, Access<Archive, CmcResult>& value) {
  auto& [excitation,
         activation,
         fiber_length,
         norm_fiber_velocity,
         tendon_force,
         passive_fiber_force,
         path_length,
         actuator_force,
         pose,
         speed,
         muscle_moment,
         tracking_error,
         stop,
         infeasible_windows,
         counters,
         options] = value;
  archive(excitation,
          activation,
          fiber_length,
          norm_fiber_velocity,
          tendon_force,
          passive_fiber_force,
          path_length,
          actuator_force,
          pose,
          speed,
          muscle_moment,
          tracking_error,
          stop,
          infeasible_windows,
          counters,
          options);
}

}  // namespace gaitmill
