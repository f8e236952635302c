#include "service/job_composer.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "service/job_input.h"

namespace gaitmill {

namespace {

const api::UnderstoodFile* findPart(const api::TrialView& trial, const std::string& part) {
  const auto found = std::find_if(
      trial.files.begin(), trial.files.end(), [&](const auto& file) { return file.part == part; });
  return found == trial.files.end() ? nullptr : &*found;
}

bool hasForces(const api::UnderstoodFile& file) {
  return file.recording &&
         std::any_of(file.recording->plates.begin(),
                     file.recording->plates.end(),
                     [](const api::PlateView& plate) { return plate.refusal.empty(); });
}

// What the quota counts: the frames of the movement.
std::int64_t countFrames(const api::TrialView& trial) {
  for (const char* part : {"markers", "coordinates"}) {
    const api::UnderstoodFile* file = findPart(trial, part);
    if (file != nullptr && file->frames) {
      return *file->frames;
    }
  }
  return 0;
}

}  // namespace

JobComposer::JobComposer(Stores& stores,
                         const ShippedCatalog& shipped,
                         SettingsCatalog settings,
                         const PipelineFunctions& functions)
    : stores_(stores),
      shipped_(shipped),
      settings_(std::move(settings)),
      check_input_(functions.check_input),
      default_settings_(functions.default_settings) {}

NewJob JobComposer::compose(const api::Identity& who, const api::JobRequest& request) {
  const api::TrialView trial = stores_.trials.find(who.tenant, request.trial_id);
  const InputFile settings = composeSettings(request, trial.subject);
  NewJob job;
  job.tenant = who.tenant;
  job.key_id = who.key_id;
  job.trial_id = request.trial_id;
  job.model_id = request.model_id;
  job.label = request.label;
  job.settings_name = request.settings_name;
  job.settings_json = settings.bytes;
  // Hashes first: a model or marker set that does not exist is named as such.
  job.provenance =
      calcProvenance(collectProvenance(who.tenant, trial, request.model_id, settings.bytes));
  checkInput(trial, request.model_id, settings);
  job.frames = countFrames(trial);
  if (!request.submission_key.empty()) {
    job.submission_key = who.key_id + ":" + request.submission_key;
  }
  return job;
}

Provenance JobComposer::findProvenance(const std::string& tenant, const api::JobView& job) {
  return collectProvenance(
      tenant, stores_.trials.find(tenant, job.trial_id), job.model_id, job.settings_json);
}

// A trial's options hold over the settings by name, and under a document that the job brings.
InputFile JobComposer::composeSettings(const api::JobRequest& request,
                                       const api::TrialSubject& subject) const {
  InputFile options{"trial.options", subject.options};
  if (subject.marker_set) {
    options = mergeSettings(makeMarkerSetSettings(*subject.marker_set), options);
  }
  if (!request.settings_name.empty()) {
    return mergeSettings(settings_.find(request.settings_name), options);
  }
  InputFile merged = mergeSettings(options, {"settings", request.settings_json});
  merged.name = "settings";  // where the caller looks for the field that is refused
  return merged;
}

Provenance JobComposer::collectProvenance(const std::string& tenant,
                                          const api::TrialView& trial,
                                          const std::string& model_id,
                                          const std::string& settings_json) {
  Provenance provenance;
  for (const api::UnderstoodFile& file : trial.files) {
    if (file.part != "model") {
      provenance.inputs[file.part] = file.sha256;
    }
  }
  provenance.mass = trial.subject.mass;
  provenance.height = trial.subject.height;
  provenance.model = findModelHash(tenant, trial, model_id);
  provenance.marker_set =
      findMarkerSetHash(tenant, findMarkerSet(settings_json, default_settings_));
  provenance.settings_json = settings_json;
  provenance.code = sourceVersion();
  return provenance;
}

std::string JobComposer::findModelHash(const std::string& tenant,
                                       const api::TrialView& trial,
                                       const std::string& model_id) {
  if (isUploadedId(model_id)) {
    return stores_.models.find(tenant, model_id).sha256;
  }
  const api::UnderstoodFile* own = findPart(trial, "model");
  if (model_id.empty() && own != nullptr) {
    return own->sha256;
  }
  const ShippedDocument* shipped =
      shipped_.findModel(model_id.empty() ? ShippedCatalog::kDefaultModel : model_id);
  require(shipped != nullptr || model_id.empty(),
          ErrorCode::kModelNotFound,
          "there is no model '" + model_id + "'",
          {"", 0, 0, "model"});
  return shipped == nullptr ? "" : shipped->entry.sha256;
}

// A shipped set that does not exist is the pipeline's to refuse.
std::string JobComposer::findMarkerSetHash(const std::string& tenant,
                                           const std::string& marker_set) {
  if (isUploadedId(marker_set)) {
    return stores_.marker_sets.find(tenant, marker_set).sha256;
  }
  const ShippedDocument* shipped = shipped_.findMarkerSet(marker_set);
  return shipped == nullptr ? "" : shipped->entry.sha256;
}

// The check looks at which files there are, so they go without their bytes.
void JobComposer::checkInput(const api::TrialView& trial,
                             const std::string& model_id,
                             const InputFile& settings) const {
  JobInput input;
  input.mass = trial.subject.mass;
  input.height = trial.subject.height;
  const auto nothing = api::makeByteSource("");
  for (const api::UnderstoodFile& file : trial.files) {
    input.parts[file.part] = {file.name, nothing};
  }
  // Without its bytes nobody sees that the markers' file brings forces along.
  const api::UnderstoodFile* const markers = findPart(trial, "markers");
  if (markers != nullptr && hasForces(*markers) && input.parts.count("grf") == 0) {
    input.parts["grf"] = input.parts["markers"];
  }
  if (!model_id.empty()) {
    input.parts["model"] = {model_id, nothing};
  }
  const std::string marker_set = findMarkerSet(settings.bytes, default_settings_);
  if (isUploadedId(marker_set)) {
    input.parts["marker_set"] = {marker_set, nothing};
  }
  check_input_(makeTrialInput(input), settings);
}

}  // namespace gaitmill
