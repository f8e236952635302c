#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/ports.h"
#include "core/base/error.h"
#include "core/figure/svg.h"
#include "core/figure/vega_lite.h"

namespace gaitmill {

inline constexpr const char* kTrialId = "tri_01hf3v6k9e2m8xw7p0q4t5r6s1";
inline constexpr const char* kJobId = "job_01hf3v6k9e2m8xw7p0q4t5r6s1";
inline constexpr const char* kStudyId = "stu_01hf3v6k9e2m8xw7p0q4t5r6s1";
inline constexpr const char* kKeyId = "key_01hf3v6k9e2m8xw7p0q4t5r6s1";
inline constexpr const char* kModelId = "mod_01hf3v6k9e2m8xw7p0q4t5r6s1";

/// What the stubs were asked and answer, and what they throw instead of answering.
struct StubRecord {
  std::vector<std::string> calls;
  std::optional<Error> failure;
  std::string tenant;  ///< of the last call
  api::TrialUpload upload;
  std::pair<std::string, api::UploadedFile> file;  ///< part and file of the last PUT
  api::JobRequest request;
  api::StudyRequest study;
  api::ListFilter filter;
  api::PageRequest page;
  api::ImageRequest image;
  std::string document;  ///< of the last model or marker set
  std::string next_cursor;
  api::JobState state = api::JobState::kRunning;  ///< of the job that is found
  std::vector<api::JobEvent> events;
  std::string unreadiness;
  bool is_final = true;  ///< of the tables
  std::mutex mutex;      ///< of calls, tenant and failure

  void failWith(std::optional<Error> error) {
    const std::lock_guard lock(mutex);
    failure = std::move(error);
  }

  void note(const api::Identity& who, const std::string& call) {
    const std::lock_guard lock(mutex);
    calls.push_back(call);
    tenant = who.tenant;
    if (failure) {
      throw Error(*failure);
    }
  }
};

inline api::TrialView makeTrialView() {
  api::TrialView trial;
  trial.id = kTrialId;
  trial.created_at = 1'700'000'000'123;
  trial.subject = {75.3, 1.7, "lab_a", R"({"ik":{"end_s":1.0}})", "S07", "walk 3"};
  api::UnderstoodFile markers;
  markers.part = "markers";
  markers.name = "walk.trc";
  markers.size = 9;
  markers.sha256 = std::string(64, 'a');
  markers.format = "trc";
  markers.frames = 300;
  markers.rate = 100.0;
  markers.start = 0.0;
  markers.end = 2.99;
  markers.units = "mm";
  markers.labels_kind = "markers";
  markers.labels = {"RASI", "LASI"};
  markers.marker_sets = {{"lab_a", {"RASI"}, {"RTOE"}}};
  api::UnderstoodFile forces;
  forces.part = "grf";
  forces.name = "walk.mot";
  forces.sha256 = std::string(64, 'c');
  forces.format = "table";
  forces.labels_kind = "forces";
  forces.labels = {"1"};
  forces.contacts = {{"1", "right", 0.5, 1.1, true, true}, {"1", "", 2.5, 2.99, true, false}};
  trial.files = {markers, forces};
  trial.events = {{"foot_strike", "right", 0.5}, {"toe_off", "right", 1.1}};
  trial.warnings = {"walk.trc: a cut last row"};
  return trial;
}

inline api::JobView makeJobView(api::JobState state) {
  api::JobView job;
  job.id = kJobId;
  job.trial_id = kTrialId;
  job.settings_name = "default";
  job.settings_json = R"({"ik":{}})";
  job.state = state;
  job.version = 7;
  job.attempt = 1;
  job.submitted_at = 1'700'000'000'000;
  job.started_at = 1'700'000'001'000;
  job.stages = {{"scale", 0.25, 1.0}, {"ik", 1.5, 0.5}};
  job.provenance = std::string(64, 'd');
  return job;
}

inline api::StudyView makeStudyView() {
  api::StudyView study;
  study.id = kStudyId;
  study.name = "spring";
  study.created_at = 1'700'000'000'000;
  study.version = 3;
  study.jobs = {{"queued", 1}, {"running", 0}, {"succeeded", 1}, {"failed", 0}, {"cancelled", 0}};
  study.progress = 0.5;
  study.job_ids = {kJobId};
  return study;
}

inline api::FileContent makeFileContent(const std::string& name) {
  return {{name, 5, std::string(64, 'b')}, api::makeByteSource("bytes")};
}

class StubTrials : public api::TrialPort {
 public:
  explicit StubTrials(StubRecord& record) : record_(record) {}
  api::TrialView validate(const api::Identity& who, const api::TrialUpload& upload) override {
    record_.upload = upload;
    record_.note(who, "validate trial");
    api::TrialView trial = makeTrialView();
    trial.id.clear();
    return trial;
  }
  api::TrialView submit(const api::Identity& who, const api::TrialUpload& upload) override {
    record_.upload = upload;
    record_.note(who, "submit trial");
    return makeTrialView();
  }
  api::TrialView putFile(const api::Identity& who,
                         const std::string& trial_id,
                         const std::string& part,
                         const api::UploadedFile& file) override {
    record_.file = {part, file};
    record_.note(who, "put file " + trial_id + " " + part);
    return makeTrialView();
  }
  api::Page<api::TrialView> list(const api::Identity& who,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page) override {
    record_.filter = filter;
    record_.page = page;
    record_.note(who, "list trials");
    return {{makeTrialView()}, record_.next_cursor};
  }
  api::TrialView find(const api::Identity& who, const std::string& trial_id) override {
    record_.note(who, "find trial " + trial_id);
    return makeTrialView();
  }
  api::FileContent findFile(const api::Identity& who,
                            const std::string& trial_id,
                            const std::string& part) override {
    record_.note(who, "find file " + trial_id + " " + part);
    return makeFileContent("walk.trc");
  }
  void remove(const api::Identity& who, const std::string& trial_id) override {
    record_.note(who, "remove trial " + trial_id);
  }

 private:
  StubRecord& record_;
};

class StubJobs : public api::JobPort {
 public:
  explicit StubJobs(StubRecord& record) : record_(record) {}
  api::JobView submit(const api::Identity& who, const api::JobRequest& request) override {
    record_.request = request;
    record_.note(who, "submit job");
    api::JobView job = makeJobView(api::JobState::kQueued);
    job.jobs_ahead = 2;
    return job;
  }
  api::Page<api::JobView> list(const api::Identity& who,
                               const api::ListFilter& filter,
                               const api::PageRequest& page) override {
    record_.filter = filter;
    record_.page = page;
    record_.note(who, "list jobs");
    api::JobView job = makeJobView(api::JobState::kRunning);
    job.settings_json.clear();
    return {{job}, record_.next_cursor};
  }
  api::JobView find(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "find job " + job_id);
    return makeJobView(record_.state);
  }
  api::JobView cancel(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "cancel job " + job_id);
    return makeJobView(api::JobState::kCancelled);
  }
  void remove(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "remove job " + job_id);
  }
  std::vector<api::JobEvent> listEvents(const api::Identity& who,
                                        const std::string& job_id,
                                        std::int64_t after) override {
    record_.note(who, "list events " + job_id + " " + std::to_string(after));
    std::vector<api::JobEvent> later;
    for (const api::JobEvent& event : record_.events) {
      if (event.id > after) {
        later.push_back(event);
      }
    }
    return later;
  }

 private:
  StubRecord& record_;
};

class StubStudies : public api::StudyPort {
 public:
  explicit StubStudies(StubRecord& record) : record_(record) {}
  api::StudyView submit(const api::Identity& who, const api::StudyRequest& request) override {
    record_.study = request;
    record_.note(who, "submit study");
    return makeStudyView();
  }
  api::Page<api::StudyView> list(const api::Identity& who,
                                 const api::ListFilter& filter,
                                 const api::PageRequest& page) override {
    record_.filter = filter;
    record_.page = page;
    record_.note(who, "list studies");
    return {{makeStudyView()}, record_.next_cursor};
  }
  api::StudyView find(const api::Identity& who, const std::string& study_id) override {
    record_.note(who, "find study " + study_id);
    return makeStudyView();
  }
  std::vector<api::StudyRow> listRows(const api::Identity& who,
                                      const std::string& study_id) override {
    record_.note(who, "list rows " + study_id);
    api::JobView done = makeJobView(api::JobState::kSucceeded);
    done.verdict = "pass";
    done.subject = "=S07";
    return {{done, R"({"ik":{"rms_mm":4.5}})"}, {makeJobView(api::JobState::kQueued), ""}};
  }
  api::StudyView cancel(const api::Identity& who, const std::string& study_id) override {
    record_.note(who, "cancel study " + study_id);
    return makeStudyView();
  }
  void remove(const api::Identity& who, const std::string& study_id) override {
    record_.note(who, "remove study " + study_id);
  }

 private:
  StubRecord& record_;
};

class StubResults : public api::ResultPort {
 public:
  explicit StubResults(StubRecord& record) : record_(record) {}
  std::vector<api::ResultView> list(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "list results " + job_id);
    return {{"kinematics", "ik", true}, {"marker_errors", "ik", false}, {"quality", "cmc", false}};
  }
  api::ResultTable findTable(const api::Identity& who,
                             const std::string& job_id,
                             const std::string& name,
                             api::TableAxis axis) override {
    record_.note(who,
                 "find table " + job_id + " " + name +
                     (axis == api::TableAxis::kCycle ? " cycle" : " time"));
    TimeSeries table = makeTimeSeries(name, {"hip_flexion_r", "soleus_l", "pelvis_ty"}, {0.0, 0.5});
    table.units = {"rad", "", "m"};
    table.values << 0.5, 0.25, 0.9, std::numeric_limits<double>::quiet_NaN(), 1.0, 0.9;
    return {table, "ik", std::string(64, 'd'), R"({"ik":{}})", record_.is_final};
  }
  std::string findQuality(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "find quality " + job_id);
    return R"({"tracking":{"rra":{"max_deg":1.5}}})";
  }
  std::string encodeSto(const TimeSeries& table, api::AngleUnit angles) override {
    return table.name + (angles == api::AngleUnit::kDegrees ? " deg" : " rad");
  }
  std::vector<api::FileView> listFiles(const api::Identity& who,
                                       const std::string& job_id) override {
    record_.note(who, "list files " + job_id);
    return {{"ik.mot", 5, std::string(64, 'b')}};
  }
  api::FileContent findFile(const api::Identity& who,
                            const std::string& job_id,
                            const std::string& name) override {
    record_.note(who, "find file " + job_id + " " + name);
    return makeFileContent(name);
  }
  api::FileContent makeArchive(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "make archive " + job_id);
    return makeFileContent(job_id + ".zip");
  }

 private:
  StubRecord& record_;
};

/// A figure with one panel and one curve, which has a hole.
inline Figure makeStubFigure(const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Joint angles";
  figure.caption = "What the markers say.";
  Panel panel;
  panel.name = "knee_angle_r";
  panel.title = "Right knee";
  panel.x = {"Gait cycle", "%", 0.0, 100.0};
  panel.y = {"Knee flexion", "deg"};
  Series series;
  series.name = "right";
  series.role = SeriesRole::kRight;
  series.x = {0.0, 50.0, 100.0};
  series.y = {5.0, std::numeric_limits<double>::quiet_NaN(), 60.0};
  panel.series = {series};
  panel.guides = {{Guide::Direction::kVertical, 62.0, "right toe-off"}};
  figure.panels = {panel};
  return figure;
}

inline std::vector<FigureInfo> listStubFigures() {
  return {{"angles", "Joint angles", "What the markers say."}};
}

class StubFigures : public api::FigurePort {
 public:
  explicit StubFigures(StubRecord& record) : record_(record) {}
  std::string findTag(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "tag figures " + job_id);
    return "tag";
  }
  std::vector<FigureInfo> list(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "list figures " + job_id);
    return listStubFigures();
  }
  Figure find(const api::Identity& who,
              const std::string& job_id,
              const std::string& name) override {
    record_.note(who, "find figure " + job_id + " " + name);
    return makeStubFigure(name);
  }
  std::string encode(const Figure& figure, api::FigureForm form) override {
    return form == api::FigureForm::kSvg    ? renderSvg(figure)
           : form == api::FigureForm::kData ? renderFigureData(figure)
                                            : renderVegaLite(figure);
  }

 private:
  StubRecord& record_;
};

class StubImages : public api::ImagePort {
 public:
  explicit StubImages(StubRecord& record) : record_(record) {}
  std::string findTag(const api::Identity& who,
                      const std::string& job_id,
                      const api::ImageRequest& request) override {
    record_.image = request;
    record_.note(who, "tag image " + job_id);
    return "tag";
  }
  api::ImageFile paint(const api::Identity& who,
                       const std::string& job_id,
                       const api::ImageRequest& request) override {
    record_.image = request;
    record_.note(who, "paint " + job_id);
    const bool is_still = request.kind != api::ImageKind::kAnimation;
    return {is_still ? "image/png" : "image/webp", api::makeByteSource("pixels")};
  }

 private:
  StubRecord& record_;
};

class StubReports : public api::ReportPort {
 public:
  explicit StubReports(StubRecord& record) : record_(record) {}
  std::string findTag(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "tag report " + job_id);
    return "tag";
  }
  std::string findQuality(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "find verdict " + job_id);
    return std::string(R"({"job":")") + job_id + R"(","verdict":"pass","provenance":")" +
           std::string(64, 'd') +
           R"(","warnings":[],"reasons":[],"stages":{},"checks":[],"figures":{},"report":"/v1/r"})";
  }
  std::string render(const api::Identity& who, const std::string& job_id) override {
    record_.note(who, "render report " + job_id);
    return "<!doctype html><title>report</title>";
  }

 private:
  StubRecord& record_;
};

class StubComparisons : public api::ComparePort {
 public:
  explicit StubComparisons(StubRecord& record) : record_(record) {}
  std::string findTag(const api::Identity& who, const std::vector<std::string>& ids) override {
    record_.note(who, "tag comparison of " + ids.front() + " and " + ids.back());
    return "tag";
  }
  api::ComparisonView compare(const api::Identity& who,
                              const std::vector<std::string>& ids) override {
    record_.note(who, "compare " + ids.front() + " and " + ids.back());
    Comparison comparison;
    comparison.labels = {"first", "second"};
    comparison.tables = {
        {"moments", {{"knee_angle_r_moment", "N.m", 50.0, {{0.5, -1.5, 62.0, 51.0}}}}}};
    comparison.quality = {{"markers.max_rms_m", {0.01, std::numeric_limits<double>::quiet_NaN()}}};
    return {comparison, listStubFigures()};
  }
  Figure find(const api::Identity& who,
              const std::vector<std::string>& ids,
              const std::string& name) override {
    record_.note(who, "overlay " + ids.front() + " and " + ids.back() + " " + name);
    return makeStubFigure(name);
  }

 private:
  StubRecord& record_;
};

class StubValidations : public api::ValidationPort {
 public:
  explicit StubValidations(StubRecord& record) : record_(record) {}
  std::string findTag(const api::Identity& who,
                      const std::string& model_id,
                      std::uint64_t seed) override {
    record_.note(who, "tag validation " + model_id + " " + std::to_string(seed));
    return "tag" + std::to_string(seed);
  }
  std::vector<FigureInfo> list(const api::Identity& who, const std::string& model_id) override {
    record_.note(who, "list validations " + model_id);
    return listStubFigures();
  }
  Figure find(const api::Identity& who,
              const std::string& model_id,
              const std::string& name,
              std::uint64_t seed) override {
    record_.note(who, "validate " + model_id + " " + name + " " + std::to_string(seed));
    return makeStubFigure(name);
  }

 private:
  StubRecord& record_;
};

class StubCatalog : public api::CatalogPort {
 public:
  StubCatalog(StubRecord& record, std::string kind) : record_(record), kind_(std::move(kind)) {}
  api::CatalogEntry add(const api::Identity& who,
                        const std::string& name,
                        std::string document) override {
    record_.document = std::move(document);
    record_.note(who, "add " + kind_ + " " + name);
    return makeEntry(name);
  }
  api::Page<api::CatalogEntry> list(const api::Identity& who,
                                    const api::PageRequest& page) override {
    record_.page = page;
    record_.note(who, "list " + kind_ + "s");
    return {{makeEntry("lab")}, record_.next_cursor};
  }
  api::CatalogEntry find(const api::Identity& who, const std::string& id) override {
    record_.note(who, "find " + kind_ + " " + id);
    return makeEntry("lab");
  }
  api::FileContent findDocument(const api::Identity& who, const std::string& id) override {
    record_.note(who, "find document " + id);
    return makeFileContent("lab.osim");
  }
  void remove(const api::Identity& who, const std::string& id) override {
    record_.note(who, "remove " + kind_ + " " + id);
  }

 private:
  static api::CatalogEntry makeEntry(const std::string& name) {
    return {kModelId, name, false, 1'700'000'000'000, 5, std::string(64, 'e'), R"({"muscles":80})"};
  }

  StubRecord& record_;
  std::string kind_;
};

class StubSettings : public api::SettingsPort {
 public:
  explicit StubSettings(StubRecord& record) : record_(record) {}
  std::vector<std::string> listNames() override {
    record_.note({}, "list settings");
    return {"default", "paper_walk"};
  }
  std::string find(const std::string& name) override {
    record_.note({}, "find settings " + name);
    return R"({"ik":{}})";
  }

 private:
  StubRecord& record_;
};

class StubKeys : public api::KeyPort {
 public:
  explicit StubKeys(StubRecord& record) : record_(record) {}
  api::KeyView add(const api::Identity& who,
                   const std::string& name,
                   const std::vector<std::string>& scopes) override {
    record_.note(who, "add key " + name);
    return {kKeyId, who.tenant, name, scopes, 1'700'000'000'000, 0, "gm_secret"};
  }
  std::vector<api::KeyView> list(const api::Identity& who) override {
    record_.note(who, "list keys");
    return {{kKeyId, who.tenant, "lab", {"read"}, 1'700'000'000'000, 1'700'000'000'001, ""}};
  }
  void revoke(const api::Identity& who, const std::string& key_id) override {
    record_.note(who, "revoke key " + key_id);
  }

 private:
  StubRecord& record_;
};

/// Keeps answers by tenant and key, as the real one does.
class StubIdempotency : public api::IdempotencyPort {
 public:
  using Key = std::pair<std::string, std::string>;

  std::optional<api::KeptAnswer> begin(const api::Identity& who,
                                       const std::string& key,
                                       const std::string& request_hash) override {
    const auto found = kept.find({who.tenant, key});
    if (found != kept.end()) {
      return found->second;
    }
    kept[{who.tenant, key}].request_hash = request_hash;
    return std::nullopt;
  }
  void finish(const api::Identity& who,
              const std::string& key,
              const api::KeptAnswer& answer) override {
    kept[{who.tenant, key}] = answer;
  }
  void abandon(const api::Identity& who, const std::string& key) override {
    kept.erase({who.tenant, key});
  }

  std::map<Key, api::KeptAnswer> kept;
};

class StubStatus : public api::StatusPort {
 public:
  explicit StubStatus(StubRecord& record) : record_(record) {}
  std::string findUnreadiness() override {
    record_.note({}, "find unreadiness");
    return record_.unreadiness;
  }
  std::string renderMetrics() override {
    record_.note({}, "render metrics");
    return "# TYPE gaitmill_jobs gauge\ngaitmill_jobs 1\n";
  }

 private:
  StubRecord& record_;
};

/// All ports on one record.
struct StubPorts {
  StubRecord record;
  StubTrials trials{record};
  StubJobs jobs{record};
  StubStudies studies{record};
  StubResults results{record};
  StubFigures figures{record};
  StubImages images{record};
  StubReports reports{record};
  StubComparisons comparisons{record};
  StubValidations validations{record};
  StubCatalog models{record, "model"};
  StubCatalog marker_sets{record, "marker set"};
  StubSettings settings{record};
  StubKeys keys{record};
  StubIdempotency idempotency;
  StubStatus status{record};

  api::Ports ports() {
    return {trials,
            jobs,
            studies,
            results,
            figures,
            images,
            reports,
            comparisons,
            validations,
            models,
            marker_sets,
            settings,
            keys,
            idempotency,
            status};
  }
};

}  // namespace gaitmill
