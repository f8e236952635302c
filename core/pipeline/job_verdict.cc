#include "core/pipeline/job_checks.h"

namespace gaitmill {

void addChecks(const Job& job, JobQuality& quality) {
  checkScale(job, quality);
  checkIk(job, quality);
  checkRra(job, quality);
  checkId(job, quality);
  checkSo(job, quality);
  checkCmc(job, quality);
}

}  // namespace gaitmill
