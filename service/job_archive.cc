#include "service/job_archive.h"

#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/figure/vega_lite.h"
#include "service/job_input.h"
#include "service/storage/sha256.h"
#include "service/storage/table_codec.h"
#include "service/stored_results.h"

namespace gaitmill {

namespace {

using nlohmann::json;

constexpr const char* kCitation =
    "Results computed by gaitmill (see provenance.json for the version).\n"
    "\n"
    "The method and the musculoskeletal model are those of\n"
    "\n"
    "  Rajagopal A, Dembia CL, DeMers MS, Delp DD, Hicks JL, Delp SL (2016). Full-body\n"
    "  musculoskeletal model for muscle-driven simulation of human gait. IEEE Transactions on\n"
    "  Biomedical Engineering 63(10):2068-2079. doi:10.1109/TBME.2016.2586891\n"
    "\n"
    "Please cite the paper when you publish results, and give the provenance hash, so that others\n"
    "can tell which numbers came from which data, model, settings and code.\n";

ZipEntry makeTextEntry(const std::string& name, std::string text) {
  return {name, [text = std::move(text)] {
            return api::makeByteSource(text);
          }};
}

std::string calcHash(const api::ByteSource& bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  Sha256 hash;
  for (std::uint64_t offset = 0; offset < bytes.size(); offset += kPiece) {
    hash.update(bytes.read(offset, kPiece));
  }
  return hash.finish();
}

}  // namespace

JobArchive::JobArchive(Stores& stores,
                       const ShippedCatalog& shipped,
                       JobComposer& composer,
                       ReportService& reports,
                       const PipelineFunctions& functions,
                       std::string folder)
    : stores_(stores),
      shipped_(shipped),
      composer_(composer),
      reports_(reports),
      encode_sto_(functions.encode_sto),
      figures_(functions.figures),
      folder_(std::move(folder)) {}

api::FileContent JobArchive::make(const api::Identity& who, const std::string& job_id) {
  const api::JobView job = stores_.jobs.find(who.tenant, job_id);
  require(job.state == api::JobState::kSucceeded,
          ErrorCode::kResultNotReady,
          "the archive is there when the job has succeeded; it is " +
              std::string(api::jobStateName(job.state)),
          {"", 0, 0, job_id});
  if (const auto kept = findKept(job_id)) {
    return *kept;
  }
  // Built without the lock: nobody waits for the archive of another job.
  api::FileContent archive = build(who, job);
  const std::lock_guard<std::mutex> lock(guard_);
  kept_.emplace_front(job_id, archive);
  kept_.resize(std::min(kept_.size(), kKept));
  return archive;
}

std::optional<api::FileContent> JobArchive::findKept(const std::string& job_id) {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto kept = std::find_if(
      kept_.begin(), kept_.end(), [&job_id](const auto& entry) { return entry.first == job_id; });
  if (kept == kept_.end()) {
    return std::nullopt;
  }
  kept_.splice(kept_.begin(), kept_, kept);
  return kept->second;
}

api::FileContent JobArchive::build(const api::Identity& who, const api::JobView& job) {
  const std::string& tenant = who.tenant;
  std::vector<ZipEntry> entries;
  addInputs(tenant, job, entries);
  addResults(tenant, job, entries);
  addViews(who, job, entries);
  entries.push_back(makeTextEntry("settings.json", json::parse(job.settings_json).dump(2) + "\n"));
  entries.push_back(makeTextEntry("provenance.json", renderOrigin(tenant, job)));
  entries.push_back(makeTextEntry("CITATION", kCitation));
  api::FileContent archive;
  archive.bytes = makeZip(std::move(entries), folder_);
  archive.view.name = job.id + ".zip";
  archive.view.size = static_cast<std::int64_t>(archive.bytes->size());
  archive.view.sha256 = calcHash(*archive.bytes);
  return archive;
}

void JobArchive::addInputs(const std::string& tenant,
                           const api::JobView& job,
                           std::vector<ZipEntry>& entries) {
  ClaimedJob claimed;
  claimed.tenant = tenant;
  claimed.trial_id = job.trial_id;
  claimed.model_id = job.model_id;
  claimed.settings_json = job.settings_json;
  for (const auto& [part, file] : readJobInput(stores_, shipped_, claimed).parts) {
    entries.push_back({"inputs/" + part + "/" + makeArchiveName(file.name), [bytes = file.bytes] {
                         return bytes;
                       }});
  }
}

void JobArchive::addResults(const std::string& tenant,
                            const api::JobView& job,
                            std::vector<ZipEntry>& entries) {
  for (const ResultInfo& result : stores_.jobs.listResults(tenant, job.id)) {
    const auto read = [this, tenant, id = job.id, result] {
      return api::makeByteSource(
          stores_.jobs.readResult(tenant, id, result.kind, result.name).bytes);
    };
    switch (result.kind) {
      case ResultKind::kFile:
        entries.push_back({"files/" + makeArchiveName(result.name), read});
        break;
      case ResultKind::kSummary:
        if (result.name == "quality") {
          entries.push_back({"results/quality.json", read});
        }
        break;
      case ResultKind::kTime:
      case ResultKind::kCycle:
        addTable(tenant, job, result, entries);
        break;
    }
  }
}

void JobArchive::addViews(const api::Identity& who,
                          const api::JobView& job,
                          std::vector<ZipEntry>& entries) {
  const auto results = std::make_shared<StoredResults>(stores_.jobs, who.tenant, job.id);
  for (const FigureInfo& info : figures_.list(*results)) {
    entries.push_back(
        {"plots/" + makeArchiveName(info.name) + ".vl.json", [this, results, name = info.name] {
           return api::makeByteSource(renderVegaLite(figures_.make(*results, name)));
         }});
  }
  entries.push_back(makeTextEntry("report.html", reports_.render(who, job.id)));
  for (NamedImage& named : reports_.paintInstants(who, job.id)) {
    entries.push_back(
        makeTextEntry("images/" + makeArchiveName(named.file_name), std::move(named.image.bytes)));
  }
}

void JobArchive::addTable(const std::string& tenant,
                          const api::JobView& job,
                          const ResultInfo& stored,
                          std::vector<ZipEntry>& entries) {
  const bool is_cycle = stored.kind == ResultKind::kCycle;
  const api::TableAxis axis = is_cycle ? api::TableAxis::kCycle : api::TableAxis::kTime;
  const std::string name = "results/" + makeArchiveName(stored.name) + (is_cycle ? "_cycle" : "");
  const auto add = [&](const char* extension, const auto& render) {
    entries.push_back({name + extension, [this, tenant, job, stored, render] {
                         return api::makeByteSource(render(readTable(tenant, job, stored)));
                       }});
  };
  add(".csv",
      [axis](const api::ResultTable& result) { return api::renderTableCsv(result.table, axis); });
  add(".json",
      [axis](const api::ResultTable& result) { return api::renderTableJson(result, axis); });
  if (!is_cycle) {
    add(".sto", [this](const api::ResultTable& result) {
      return encode_sto_(result.table, api::AngleUnit::kRadians);
    });
  }
}

api::ResultTable JobArchive::readTable(const std::string& tenant,
                                       const api::JobView& job,
                                       const ResultInfo& stored) {
  api::ResultTable result;
  result.table =
      decodeTable(stores_.jobs.readResult(tenant, job.id, stored.kind, stored.name).bytes);
  result.stage = stored.stage;
  result.provenance = job.provenance;
  result.settings_json = job.settings_json;
  result.is_final = true;
  return result;
}

// The ingredients of the job's provenance. Another version of gaitmill than the one that took the
// job cannot name that one's sources; the hash then stands alone.
std::string JobArchive::renderOrigin(const std::string& tenant, const api::JobView& job) {
  const Provenance provenance = composer_.findProvenance(tenant, job);
  json origin = json::parse(renderProvenance(provenance));
  if (calcProvenance(provenance) != job.provenance) {
    origin["code"] = nullptr;
  }
  origin.erase("settings");
  origin["provenance_sha256"] = job.provenance;
  origin["settings_file"] = "settings.json";
  return origin.dump(2) + "\n";
}

}  // namespace gaitmill
