#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gaitmill {

/// A figure with the three digits that a judgement needs: "0.25", "12.3", "120".
std::string formatFigure(double value);

/// How far to trust results: as good as the field asks for, to be looked at, or not to be used.
enum class Verdict { kPass, kWarn, kFail };

/// "pass", "warn", "fail"
const char* verdictName(Verdict verdict);

/// One figure of a result held against its bounds. Values up to `limit` pass, up to `fail_above`
/// they are a warning. A figure that is not a number cannot be judged and warns.
struct QualityCheck {
  std::string stage;   ///< that is judged: "ik"
  std::string figure;  ///< "residual_force_peak"
  std::string worst;   ///< actuator, coordinate, marker or joint that has the value; may be empty
  std::string unit;    ///< "N", "N.m", "deg", "cm", "%"; empty for what is or is not so
  double value = std::numeric_limits<double>::quiet_NaN();
  double limit = 0;
  double fail_above = 0;  ///< infinite where this figure alone never condemns a result
  std::string meaning;    ///< "the residual force at the pelvis peaks at"
  std::string source;     ///< of the limit; "gaitmill: …" with the reason where nobody gives one
  std::string fail_source;  ///< of fail_above
  std::string cause;        ///< what is likely wrong if it does not pass; sentences
  std::string fix;          ///< what to do about it; sentences

  Verdict judge() const;
  /// "the residual force at the pelvis peaks at 38.2 N (FX); the limit is 25 N"
  std::string explain() const;
};

/// The worst of all; a pass if there are none.
Verdict judgeAll(const std::vector<QualityCheck>& checks);

}  // namespace gaitmill
