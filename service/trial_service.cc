#include "service/trial_service.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;  // [bytes] hashed at a time

std::string calcHash(const api::ByteSource& bytes) {
  Sha256 hash;
  const std::uint64_t size = bytes.size();
  for (std::uint64_t offset = 0; offset < size;) {
    const std::string piece = bytes.read(offset, kPiece);
    check(!piece.empty(), "an uploaded file ends early");
    hash.update(piece);
    offset += piece.size();
  }
  return hash.finish();
}

std::uint64_t sumSizes(const api::TrialUpload& upload) {
  std::uint64_t sum = 0;
  for (const auto& [part, file] : upload.files) {
    sum += file.bytes->size();
  }
  return sum;
}

void requirePart(const std::string& part) {
  const std::vector<std::string>& parts = api::trialParts();
  const std::string nearest = findNearestName(part, parts);
  require(std::find(parts.begin(), parts.end(), part) != parts.end(),
          ErrorCode::kRequestField,
          "a trial has no part '" + part + "'" +
              (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
          {"", 0, 0, part});
}

// Takes over what has just been understood of the other files too, as far as they are still those
// that were read.
void takeOver(const api::TrialView& understood, const std::string& part, api::TrialView& stored) {
  stored.marker_names = understood.marker_names;
  stored.events = understood.events;
  stored.warnings = understood.warnings;
  for (api::UnderstoodFile& file : stored.files) {
    const auto found =
        std::find_if(understood.files.begin(), understood.files.end(), [&](const auto& other) {
          return other.part == file.part && other.part != part;
        });
    if (found != understood.files.end()) {
      api::UnderstoodFile fresh = *found;
      fresh.size = file.size;
      fresh.sha256 = file.sha256;
      file = std::move(fresh);
    }
  }
}

}  // namespace

TrialService::TrialService(Stores& stores,
                           const KnownMarkerSets& marker_sets,
                           TrialInspector inspect,
                           const Quota& quota)
    : stores_(stores), marker_sets_(marker_sets), inspect_(std::move(inspect)), quota_(quota) {}

api::TrialView TrialService::validate(const api::Identity& who, const api::TrialUpload& upload) {
  checkUpload(who, upload);
  api::TrialView view = inspect(upload);
  view.subject = upload.subject;
  for (api::UnderstoodFile& file : view.files) {
    const api::ByteSource& bytes = *upload.files.at(file.part).bytes;
    file.size = static_cast<std::int64_t>(bytes.size());
    file.sha256 = calcHash(bytes);
  }
  return match(who, std::move(view));
}

api::TrialView TrialService::submit(const api::Identity& who, const api::TrialUpload& upload) {
  checkUpload(who, upload);
  stores_.database.requireRoom(sumSizes(upload));
  NewTrial trial;
  trial.tenant = who.tenant;
  trial.key_id = who.key_id;
  trial.subject = upload.subject;
  trial.files = upload.files;
  trial.understanding = inspect(upload);
  if (!upload.submission_key.empty()) {
    trial.submission_key = who.key_id + ":" + upload.submission_key;
  }
  return match(who, stores_.trials.add(trial, quota_));
}

api::TrialView TrialService::putFile(const api::Identity& who,
                                     const std::string& trial_id,
                                     const std::string& part,
                                     const api::UploadedFile& file) {
  requirePart(part);
  stores_.database.requireRoom(file.bytes->size());
  const std::lock_guard<std::mutex> lock(put_guard_);
  api::TrialUpload whole;
  whole.subject = stores_.trials.findSubject(who.tenant, trial_id);
  whole.files = stores_.trials.readFiles(who.tenant, trial_id);
  whole.files[part] = file;
  const api::TrialView understood = inspect(whole);
  const auto own = std::find_if(understood.files.begin(),
                                understood.files.end(),
                                [&](const auto& f) { return f.part == part; });
  check(own != understood.files.end(), "an uploaded file was not read");
  return match(who,
               stores_.trials.putFile(
                   who.tenant,
                   trial_id,
                   file,
                   *own,
                   [&](api::TrialView& stored) { takeOver(understood, part, stored); },
                   quota_));
}

api::Page<api::TrialView> TrialService::list(const api::Identity& who,
                                             const api::ListFilter& filter,
                                             const api::PageRequest& page) {
  api::Page<api::TrialView> trials = stores_.trials.list(who.tenant, filter, page);
  const auto sets = marker_sets_.list(who.tenant);
  for (api::TrialView& trial : trials.items) {
    KnownMarkerSets::match(sets, trial);
  }
  return trials;
}

api::TrialView TrialService::find(const api::Identity& who, const std::string& trial_id) {
  return match(who, stores_.trials.find(who.tenant, trial_id));
}

api::FileContent TrialService::findFile(const api::Identity& who,
                                        const std::string& trial_id,
                                        const std::string& part) {
  return stores_.trials.readFile(who.tenant, trial_id, part);
}

void TrialService::remove(const api::Identity& who, const std::string& trial_id) {
  stores_.trials.remove(who.tenant, trial_id);
}

// An upload without files is a trial to put files into, one by one.
void TrialService::checkUpload(const api::Identity& who, const api::TrialUpload& upload) const {
  require(
      upload.files.empty() || upload.files.count("markers") + upload.files.count("coordinates") > 0,
      ErrorCode::kInputMissing,
      "a trial needs the part 'markers', or 'coordinates' if its kinematics are known",
      {"", 0, 0, "markers"});
  if (upload.subject.marker_set) {
    marker_sets_.require(who.tenant, *upload.subject.marker_set);
  }
}

api::TrialView TrialService::inspect(const api::TrialUpload& upload) const {
  return upload.files.empty() ? api::TrialView{} : inspect_(upload);
}

api::TrialView TrialService::match(const api::Identity& who, api::TrialView view) const {
  KnownMarkerSets::match(marker_sets_.list(who.tenant), view);
  return view;
}

}  // namespace gaitmill
