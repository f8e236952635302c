#pragma once

#include <string>
#include <vector>

#include "core/analysis/quality_check.h"

namespace gaitmill {

/// What is asked of one figure of a result: bounds with their sources, and what to tell the user
/// who does not meet them. "{worst}" in the texts stands for the actuator, marker, … concerned.
struct QualityRule {
  const char* stage;
  const char* figure;
  const char* unit;
  double limit;
  double fail_above;
  const char* source;
  const char* fail_source;
  const char* meaning;
  const char* cause;
  const char* fix;
};

/// All rules, in the order of the stages.
const std::vector<QualityRule>& qualityRules();

/// The check that a rule asks for. @throws Error kInternal if there is no rule of that name
QualityCheck makeQualityCheck(const std::string& figure, double value, const std::string& worst);

}  // namespace gaitmill
