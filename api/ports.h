#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/catalog.h"
#include "api/dto/image.h"
#include "api/dto/job.h"
#include "api/dto/page.h"
#include "api/dto/result.h"
#include "api/dto/study.h"
#include "api/dto/trial.h"
#include "api/http.h"
#include "api/identity.h"
#include "core/data/comparison.h"
#include "core/data/figure.h"
#include "core/data/time_series.h"

namespace gaitmill::api {

/// All that a route may ask for. Implemented by the service on top of its storage, and by recording
/// stubs in tests. Implementations are called from several threads at once and answer quickly: no
/// solver runs behind a port, and only what draws takes its time. Ids of another tenant do not
/// exist: every look-up throws the same Error k…NotFound for them as for ids that nobody has.

class TrialPort {
 public:
  virtual ~TrialPort() = default;
  /// Reads every file and says what was understood, storing nothing (id is empty).
  /// @throws Error of the parser with file, line and column; kInputMissing; kRequestField
  virtual TrialView validate(const Identity& who, const TrialUpload& upload) = 0;
  /// The same, and stores the trial durably. An upload without files is a trial to put files into.
  /// @throws also Error kQuotaExceeded, kStorageFull
  virtual TrialView submit(const Identity& who, const TrialUpload& upload) = 0;
  /// Adds or replaces one file. @throws Error kTrialInUse once a job refers to the trial
  virtual TrialView putFile(const Identity& who,
                            const std::string& trial_id,
                            const std::string& part,
                            const UploadedFile& file) = 0;
  virtual Page<TrialView> list(const Identity& who,
                               const ListFilter& filter,
                               const PageRequest& page) = 0;
  /// @throws Error kTrialNotFound
  virtual TrialView find(const Identity& who, const std::string& trial_id) = 0;
  /// @throws Error kTrialNotFound, kResultNotFound
  virtual FileContent findFile(const Identity& who,
                               const std::string& trial_id,
                               const std::string& part) = 0;
  /// Takes the bytes off the disk. @throws Error kTrialNotFound, kTrialInUse if jobs refer to it
  virtual void remove(const Identity& who, const std::string& trial_id) = 0;
};

class JobPort {
 public:
  virtual ~JobPort() = default;
  /// Durable before it returns.
  /// @throws Error kTrialNotFound, kModelNotFound, kSettings..., kInputMissing, kQuotaExceeded
  virtual JobView submit(const Identity& who, const JobRequest& request) = 0;
  virtual Page<JobView> list(const Identity& who,
                             const ListFilter& filter,
                             const PageRequest& page) = 0;
  /// @throws Error kJobNotFound
  virtual JobView find(const Identity& who, const std::string& job_id) = 0;
  /// A queued job is cancelled at once, a running one within 100 ms.
  /// @throws Error kJobNotFound; kJobState if the job has already succeeded or failed
  virtual JobView cancel(const Identity& who, const std::string& job_id) = 0;
  /// With its results. @throws Error kJobNotFound; kJobState if it is not final
  virtual void remove(const Identity& who, const std::string& job_id) = 0;
  /// Events after `after`, oldest first, at most 1000. @throws Error kJobNotFound
  virtual std::vector<JobEvent> listEvents(const Identity& who,
                                           const std::string& job_id,
                                           std::int64_t after) = 0;
};

class StudyPort {
 public:
  virtual ~StudyPort() = default;
  /// All jobs or none. @throws as JobPort::submit
  virtual StudyView submit(const Identity& who, const StudyRequest& request) = 0;
  virtual Page<StudyView> list(const Identity& who,
                               const ListFilter& filter,
                               const PageRequest& page) = 0;
  /// @throws Error kStudyNotFound
  virtual StudyView find(const Identity& who, const std::string& study_id) = 0;
  virtual std::vector<StudyRow> listRows(const Identity& who, const std::string& study_id) = 0;
  /// Cancels its jobs that have not ended.
  virtual StudyView cancel(const Identity& who, const std::string& study_id) = 0;
  /// With its jobs and their results. @throws Error kJobState while one of them has not ended
  virtual void remove(const Identity& who, const std::string& study_id) = 0;
};

class ResultPort {
 public:
  virtual ~ResultPort() = default;
  /// What there is so far, by name.
  virtual std::vector<ResultView> list(const Identity& who, const std::string& job_id) = 0;
  /// A table in SI units and radians; on the cycle axis `time` holds percent. Readable as soon as
  /// its stage has finished.
  /// @throws Error kJobNotFound; kResultNotReady before; kResultNotFound if the job has none
  virtual ResultTable findTable(const Identity& who,
                                const std::string& job_id,
                                const std::string& name,
                                TableAxis axis) = 0;
  /// The quality figures, a JSON object. @throws as findTable
  virtual std::string findQuality(const Identity& who, const std::string& job_id) = 0;
  /// Bytes of an OpenSim storage file with the table's angles in this unit, as its header says.
  virtual std::string encodeSto(const TimeSeries& table, AngleUnit angles) = 0;
  virtual std::vector<FileView> listFiles(const Identity& who, const std::string& job_id) = 0;
  virtual FileContent findFile(const Identity& who,
                               const std::string& job_id,
                               const std::string& name) = 0;
  /// Everything of a succeeded job as one zip: inputs, results, models, settings, checksums,
  /// citation. @throws Error kResultNotReady
  virtual FileContent makeArchive(const Identity& who, const std::string& job_id) = 0;
};

/// What is drawn and said of results. A tag is equal as long as all that is made of the same
/// results is equal: over the job's provenance and the code that draws, so that a client's copy is
/// known to be good before anything is made. Letters, digits and '.', as an ETag may have them.

/// How a figure is written down: as a Vega-Lite specification, as the bare series, as a drawing.
enum class FigureForm { kVegaLite, kData, kSvg };

/// Figures of a job, from the tables it has so far.
class FigurePort {
 public:
  virtual ~FigurePort() = default;
  /// @throws Error kJobNotFound
  virtual std::string findTag(const Identity& who, const std::string& job_id) = 0;
  virtual std::vector<FigureInfo> list(const Identity& who, const std::string& job_id) = 0;
  /// @throws Error kJobNotFound; kResultNotReady while the job may still get it; kFigureNotFound
  ///         naming the nearest
  virtual Figure find(const Identity& who, const std::string& job_id, const std::string& name) = 0;
  /// Any figure as text.
  virtual std::string encode(const Figure& figure, FigureForm form) = 0;
};

/// An image file in memory, shared with the cache that keeps it.
struct ImageFile {
  std::string content_type;
  std::shared_ptr<const ByteSource> bytes;
};

class ImagePort {
 public:
  virtual ~ImagePort() = default;
  /// @throws Error kJobNotFound
  virtual std::string findTag(const Identity& who,
                              const std::string& job_id,
                              const ImageRequest& request) = 0;
  /// Draws, or takes from the cache. Waits for its turn: one image is drawn at a time.
  /// @throws Error kJobNotFound; kResultNotReady while there is no motion; kRequestField naming
  ///         what there is; kImageSize, kQuotaExceeded; kRequestBusy if too many wait; kRender
  virtual ImageFile paint(const Identity& who,
                          const std::string& job_id,
                          const ImageRequest& request) = 0;
};

class ReportPort {
 public:
  virtual ~ReportPort() = default;
  /// @throws Error kJobNotFound
  virtual std::string findTag(const Identity& who, const std::string& job_id) = 0;
  /// The verdict with everything that it rests on, a JSON object.
  /// @throws Error kJobNotFound; kResultNotReady unless the job has succeeded
  virtual std::string findQuality(const Identity& who, const std::string& job_id) = 0;
  /// One self-contained HTML file. @throws as findQuality, and as ImagePort::paint
  virtual std::string render(const Identity& who, const std::string& job_id) = 0;
};

/// Differences between jobs.
struct ComparisonView {
  Comparison comparison;
  std::vector<FigureInfo> figures;  ///< that all of the jobs have
};

/// Jobs held against the first of them. At least two ids, each once.
class ComparePort {
 public:
  virtual ~ComparePort() = default;
  /// @throws Error kJobNotFound
  virtual std::string findTag(const Identity& who, const std::vector<std::string>& job_ids) = 0;
  /// @throws Error kJobNotFound; kResultNotReady unless all have succeeded
  virtual ComparisonView compare(const Identity& who, const std::vector<std::string>& job_ids) = 0;
  /// @throws as compare; kFigureNotFound
  virtual Figure find(const Identity& who,
                      const std::vector<std::string>& job_ids,
                      const std::string& name) = 0;
};

/// Validation figures of a model.
class ValidationPort {
 public:
  virtual ~ValidationPort() = default;
  /// @param seed  of random draws
  /// @throws Error kModelNotFound
  virtual std::string findTag(const Identity& who,
                              const std::string& model_id,
                              std::uint64_t seed) = 0;
  /// @throws Error kModelNotFound; of the reader that refuses the model; kRequestBusy; kRender
  virtual std::vector<FigureInfo> list(const Identity& who, const std::string& model_id) = 0;
  /// @throws as list; kFigureNotFound
  virtual Figure find(const Identity& who,
                      const std::string& model_id,
                      const std::string& name,
                      std::uint64_t seed) = 0;
};

/// Models, or marker sets: one port for each.
class CatalogPort {
 public:
  virtual ~CatalogPort() = default;
  /// @throws Error of the reader that refuses the document
  virtual CatalogEntry add(const Identity& who, const std::string& name, std::string document) = 0;
  virtual Page<CatalogEntry> list(const Identity& who, const PageRequest& page) = 0;
  /// By id, or by the name of a shipped one. @throws Error kModelNotFound or kMarkerSetNotFound
  virtual CatalogEntry find(const Identity& who, const std::string& id) = 0;
  virtual FileContent findDocument(const Identity& who, const std::string& id) = 0;
  /// @throws Error kCatalogInUse if a trial or job refers to it, or if it ships with gaitmill
  virtual void remove(const Identity& who, const std::string& id) = 0;
};

class SettingsPort {
 public:
  virtual ~SettingsPort() = default;
  virtual std::vector<std::string> listNames() = 0;
  /// A shipped document; "defaults" is the one with every field. @throws Error kSettingsNotFound
  virtual std::string find(const std::string& name) = 0;
};

/// API keys, for administrators.
class KeyPort {
 public:
  virtual ~KeyPort() = default;
  virtual KeyView add(const Identity& who,
                      const std::string& name,
                      const std::vector<std::string>& scopes) = 0;
  virtual std::vector<KeyView> list(const Identity& who) = 0;
  /// @throws Error kKeyNotFound
  virtual void revoke(const Identity& who, const std::string& key_id) = 0;
};

/// The first answer to a request with an Idempotency-Key, kept for a day.
struct KeptAnswer {
  std::string request_hash;  ///< of method, path and body
  int status = 0;            ///< 0 while the first request is still being answered
  std::string content_type;
  std::string location;
  std::string body;
};

class IdempotencyPort {
 public:
  virtual ~IdempotencyPort() = default;
  /// Claims the key for this request, or returns what is there.
  virtual std::optional<KeptAnswer> begin(const Identity& who,
                                          const std::string& key,
                                          const std::string& request_hash) = 0;
  virtual void finish(const Identity& who, const std::string& key, const KeptAnswer& answer) = 0;
  /// Gives the key back: the request failed on our side and may be sent again.
  virtual void abandon(const Identity& who, const std::string& key) = 0;
};

/// What operators ask.
class StatusPort {
 public:
  virtual ~StatusPort() = default;
  /// Empty if jobs can be taken, else the reason why not.
  virtual std::string findUnreadiness() = 0;
  /// Prometheus text format 0.0.4.
  virtual std::string renderMetrics() = 0;
};

struct Ports {
  TrialPort& trials;
  JobPort& jobs;
  StudyPort& studies;
  ResultPort& results;
  FigurePort& figures;
  ImagePort& images;
  ReportPort& reports;
  ComparePort& comparisons;
  ValidationPort& validations;
  CatalogPort& models;
  CatalogPort& marker_sets;
  SettingsPort& settings;
  KeyPort& keys;
  IdempotencyPort& idempotency;
  StatusPort& status;
};

}  // namespace gaitmill::api
