#include "service/job_tag.h"

#include "api/digest.h"
#include "service/provenance.h"
#include "service/version.h"

namespace gaitmill {

namespace {

constexpr std::size_t kTagLength = 32;

}  // namespace

std::string makeTag(const std::vector<std::string>& texts) {
  std::vector<std::string> all = {sourceVersion(), kVersion};
  all.insert(all.end(), texts.begin(), texts.end());
  return api::hashTexts(all).substr(0, kTagLength);
}

std::string identifyResults(const api::JobView& job) {
  return job.state == api::JobState::kSucceeded ? job.provenance
                                                : job.id + "." + std::to_string(job.version);
}

}  // namespace gaitmill
