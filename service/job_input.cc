#include "service/job_input.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"

namespace gaitmill {

namespace {

using nlohmann::json;

std::optional<std::string> readMarkerSetName(const std::string& settings_json) {
  const json settings = json::parse(settings_json, nullptr, false);
  const json::json_pointer place("/scale/marker_set");
  if (!settings.is_object() || !settings.contains(place) || !settings[place].is_string()) {
    return std::nullopt;
  }
  return settings[place].get<std::string>();
}

api::UploadedFile readUploaded(CatalogStore& store,
                               const std::string& tenant,
                               const std::string& id) {
  api::FileContent document = store.readDocument(tenant, id);
  return {document.view.name, std::move(document.bytes)};
}

}  // namespace

JobInput readJobInput(Stores& stores, const ShippedCatalog& shipped, const ClaimedJob& job) {
  const api::TrialSubject subject = stores.trials.findSubject(job.tenant, job.trial_id);
  JobInput input;
  input.mass = subject.mass;
  input.height = subject.height;
  input.parts = stores.trials.readFiles(job.tenant, job.trial_id);
  if (isUploadedId(job.model_id)) {
    input.parts["model"] = readUploaded(stores.models, job.tenant, job.model_id);
  } else if (!job.model_id.empty()) {
    const ShippedDocument* model = shipped.findModel(job.model_id);
    require(model != nullptr,
            ErrorCode::kModelNotFound,
            "the model '" + job.model_id + "' does not ship with gaitmill any more",
            {"", 0, 0, "model"});
    input.parts["model"] = {model->file.name, api::makeByteSource(model->file.bytes)};
  }
  const std::string marker_set = findMarkerSet(job.settings_json, "{}");
  if (isUploadedId(marker_set)) {
    input.parts["marker_set"] = readUploaded(stores.marker_sets, job.tenant, marker_set);
  }
  return input;
}

std::string findMarkerSet(const std::string& settings_json, const std::string& default_settings) {
  const auto asked = readMarkerSetName(settings_json);
  return asked ? *asked : readMarkerSetName(default_settings).value_or("");
}

bool isUploadedId(const std::string& id) {
  return id.rfind("mod_", 0) == 0 || id.rfind("mks_", 0) == 0;
}

TrialInput makeTrialInput(const JobInput& input) {
  const auto take = [&input](const std::string& part) -> std::optional<InputFile> {
    const auto found = input.parts.find(part);
    return found == input.parts.end()
               ? std::nullopt
               : std::optional<InputFile>(
                     {found->second.name, api::readAll(*found->second.bytes, kMaximumFileSize)});
  };
  TrialInput trial;
  trial.static_markers = take("static");
  trial.static_markers_2 = take("static2");
  trial.markers = take("markers");
  trial.ground_reaction = take("grf");
  trial.emg = take("emg");
  trial.model = take("model");
  trial.coordinates = take("coordinates");
  trial.marker_set = take("marker_set");
  trial.marker_names = take("marker_names");
  trial.mass = input.mass;
  trial.height = input.height;
  return trial;
}

}  // namespace gaitmill
