#include <string>

#include "api/dto/job.h"
#include "api/dto/study.h"
#include "api/dto/trial.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// The JSON bodies that clients send.
GAITMILL_FUZZ_TARGET(request) {
  const std::string json(input);
  tryParse([&] { api::parseTrialSubject(json); });
  tryParse([&] { api::parseJobRequest(json); });
  tryParse([&] { api::parseStudyRequest(json); });
}

}  // namespace gaitmill
