#pragma once

namespace gaitmill {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegreesPerRadian = 180.0 / kPi;
inline constexpr double kRadiansPerDegree = kPi / 180.0;

/// Magnitude of the gravity that the model documents state [m/s^2] (their vector is (0, -g, 0)).
inline constexpr double kGravity = 9.80665;

constexpr double toDegrees(double radians) {
  return radians * kDegreesPerRadian;
}
constexpr double toRadians(double degrees) {
  return degrees * kRadiansPerDegree;
}

}  // namespace gaitmill
