#include "service/trial_service.h"

#include <map>
#include <optional>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

TrialService::TrialService(TrialStore& store, TrialInspector inspect)
    : store_(store), inspect_(std::move(inspect)) {}

api::TrialView TrialService::submit(api::TrialUpload upload) {
  require(upload.files.count("markers") + upload.files.count("coordinates") > 0,
          ErrorCode::kInputMissing,
          "a trial needs the part 'markers', or 'coordinates' if its kinematics are known",
          {"", 0, 0, "markers"});
  return store_.add(upload, inspect_(upload));
}

api::TrialView TrialService::find(const std::string& trial_id) {
  return store_.find(trial_id);
}

TrialInput readTrialInput(TrialStore& store, const std::string& trial_id) {
  const api::TrialSubject subject = store.findSubject(trial_id);
  std::map<std::string, api::UploadedFile> files = store.readFiles(trial_id);
  const auto take = [&files](const std::string& part) -> std::optional<InputFile> {
    const auto found = files.find(part);
    return found == files.end() ? std::nullopt
                                : std::optional<InputFile>({std::move(found->second.name),
                                                            std::move(found->second.bytes)});
  };
  TrialInput input;
  input.static_markers = take("static");
  input.static_markers_2 = take("static2");
  input.markers = take("markers");
  input.ground_reaction = take("grf");
  input.emg = take("emg");
  input.model = take("model");
  input.coordinates = take("coordinates");
  input.mass = subject.mass;
  input.height = subject.height;
  return input;
}

}  // namespace gaitmill
