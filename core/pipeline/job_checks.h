#pragma once

#include "core/pipeline/job.h"

namespace gaitmill {

// What a job has of each stage, held against the rules of quality_rules.h. A stage that did not run
// adds nothing.

void checkScale(const Job& job, JobQuality& quality);
void checkIk(const Job& job, JobQuality& quality);
void checkId(const Job& job, JobQuality& quality);
void checkRra(const Job& job, JobQuality& quality);
void checkSo(const Job& job, JobQuality& quality);
void checkCmc(const Job& job, JobQuality& quality);

/// Limits of a peak residual force [N], for the largest ground reaction at hand (NaN = unknown).
double findForceLimit(double peak_reaction);
/// Deviation of a coordinate in RMS and peak, rotations and translations.
void checkTracking(const char* stage, const TrackingError& error, JobQuality& quality);
/// Peak and RMS of the residuals FX … MZ, as far as all three of a kind are there, by the rules
/// "<prefix>residual_…".
void checkResiduals(const char* prefix,
                    const std::vector<ActuatorStatistics>& residuals,
                    JobQuality& quality);

}  // namespace gaitmill
