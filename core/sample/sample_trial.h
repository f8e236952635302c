#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/data/time_series.h"
#include "core/model/model.h"
#include "core/sample/gait_balance.h"

namespace gaitmill {

/// How the sample trial is recorded.
struct SampleOptions {
  int cycles = 1;                ///< whole gait cycles of the right leg
  double margin = 0.3;           ///< [s] recorded before the first and after the last heel strike
  double static_duration = 0.5;  ///< [s]
  double marker_rate = 100;      ///< [Hz]
  double force_rate = 200;       ///< [Hz] of ground reaction and EMG
  double marker_noise = 0.001;   ///< [m] standard deviation of each marker coordinate, white
  std::uint64_t seed = 2016;     ///< of the noise
  /// Markers seen while walking; the standing trial has all of the model.
  std::vector<std::string> tracked_markers = defaultTrackedMarkers();

  /// The 42 markers of the published running trial, all of them in Rajagopal2016.
  static std::vector<std::string> defaultTrackedMarkers();
};

/// A walking trial whose truth is known: what a laboratory would record, and what was put in. Time
/// 0 is the start of the record; the first right heel strike is at SampleOptions::margin.
struct SampleTrial {
  MarkerTrajectories static_markers;  ///< [m] standing still
  MarkerTrajectories markers;         ///< [m] walking, with noise
  GroundReaction ground_reaction;     ///< right and left, without noise
  TimeSeries emg;                     ///< made up, see makeEmgEnvelopes

  TimeSeries coordinates;         ///< truth [rad|m] at the frames of `markers`
  TimeSeries static_coordinates;  ///< truth of the standing pose, one row
  /// Truth: generalized forces "<coordinate>_moment" [N.m] or "_force" [N] for the ground reaction,
  /// at the same frames; zero at the pelvis.
  TimeSeries moments;
  std::vector<double> right_strikes;  ///< [s]
  BalanceReport balance;              ///< what made the fitted motion dynamically sound
};

/// Walks the subject: Fourier kinematics (GaitMotion), balanced (balanceGait), ground reactions by
/// Newton-Euler (FootLoadDistribution), markers by forward kinematics. Twice with the same
/// arguments gives the same bits.
/// @param subject  the true, scaled model; must have the coordinates and markers of Rajagopal2016
/// @throws Error kModelReference, kInputCoordinates if it has not
SampleTrial generateSampleTrial(const Model& subject, const SampleOptions& options = {});

}  // namespace gaitmill
