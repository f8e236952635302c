#pragma once

#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// Where muscle forces come from, and so what is known of the fibers.
enum class FiberSource {
  kSimulated,         ///< fiber lengths were integrated: the force is that of the state
  kRigidActive,       ///< every tendon rigid, the whole force active (static optimization)
  kRigidWithPassive,  ///< the same, the stretched fiber's own force counted beside the active one
};

/// Muscles of a motion. All tables share their rows; columns are found by name, others are ignored.
struct MuscleRecord {
  FiberSource source = FiberSource::kSimulated;
  const TimeSeries& pose;          ///< all coordinates of the model [rad|m]
  const TimeSeries& speed;         ///< [rad/s|m/s]
  const TimeSeries& activation;    ///< [-]
  const TimeSeries& tendon_force;  ///< [N]
  const TimeSeries* fiber_length;  ///< [m]; kSimulated only
};

/// What each muscle does (spec/so.md 3), on the rows of the record. With total force F along the
/// tendon, path length L, fiber length l and pennation alpha:
///   fiber powers    -f dl/dt,  f the active or the passive force along the fiber
///   tendon power    -F d(L - l cos alpha)/dt
///   muscle power    -F dL/dt = fiber powers + tendon power; positive = it gives off work
/// Damping counts as passive, in forces and in powers alike (OpenSim adds the damper's power to the
/// active one, though its force to the passive one).
struct MuscleAnalysis {
  // Columns: muscles of the model.
  TimeSeries active_fiber_forces;    ///< along the tendon [N]
  TimeSeries passive_fiber_forces;   ///< along the tendon [N]
  TimeSeries norm_fiber_lengths;     ///< l/l0M [-]
  TimeSeries norm_fiber_velocities;  ///< dl/dt over l0M vmax [-], lengthening positive
  TimeSeries pennation_angles;       ///< alpha [rad]
  TimeSeries fiber_active_powers;    ///< [W]
  TimeSeries fiber_passive_powers;   ///< [W]
  TimeSeries tendon_powers;          ///< [W]
  TimeSeries muscle_powers;          ///< [W]

  /// For each free coordinate that muscles move, moment arms times forces, the patella's arm
  /// counted with the knee's: <coordinate>_muscle_moment, of it <coordinate>_passive_moment, and
  /// <coordinate>_active_moment, the rest [N.m]; [N] of one that translates.
  TimeSeries muscle_moments;
};

/// @throws Error kTableUnknownLabel if a table lacks a coordinate or a muscle
MuscleAnalysis analyzeMuscles(const Model& model, const MuscleRecord& record);

}  // namespace gaitmill
