#include "core/analysis/quality_check.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace gaitmill {

std::string formatFigure(double value) {
  const double size = std::abs(value);
  return formatFixed(value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

const char* verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kWarn:
      return "warn";
    case Verdict::kFail:
      return "fail";
  }
  return "fail";
}

Verdict QualityCheck::judge() const {
  if (value <= limit) {
    return Verdict::kPass;
  }
  return value > fail_above ? Verdict::kFail : Verdict::kWarn;
}

std::string QualityCheck::explain() const {
  if (std::isnan(value)) {
    return meaning + " a value that could not be found";
  }
  if (unit.empty()) {
    return meaning;
  }
  return meaning + " " + formatFigure(value) + " " + unit +
         (worst.empty() ? "" : " (" + worst + ")") + "; the limit is " + formatFigure(limit) + " " +
         unit;
}

Verdict judgeAll(const std::vector<QualityCheck>& checks) {
  Verdict worst = Verdict::kPass;
  for (const QualityCheck& check : checks) {
    worst = std::max(worst, check.judge());
  }
  return worst;
}

}  // namespace gaitmill
