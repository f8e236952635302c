#pragma once

#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// Times on the ground of one foot.
struct Contact {
  double strike = 0;        ///< [s] upward crossing; the record's start if it begins loaded
  double toe_off = 0;       ///< [s] downward crossing; the record's end if it ends loaded
  bool has_strike = false;  ///< the strike lies inside the record
  bool has_toe_off = false;
};

/// Rules for finding contacts in a vertical force (spec/signal.md 7.1).
struct ContactOptions {
  double threshold = 20;          ///< [N]; 5 for forces already set to zero off the ground
  double minimum_duration = 0.1;  ///< [s] shorter contacts are dropped; 0.3 walking, 0.1 running
  double maximum_gap = 0.05;      ///< [s] shorter losses of contact are ignored
  double minimum_rise = 0.025;    ///< [s] above the threshold before a crossing counts
};

/// Contacts in time order, crossings by linear interpolation between samples.
/// @param time      [s] non-decreasing
/// @param vertical  [N] upward on the subject, one per time
std::vector<Contact> findContacts(const std::vector<double>& time,
                                  const Eigen::Ref<const Eigen::VectorXd>& vertical,
                                  const ContactOptions& options = {});

}  // namespace gaitmill
