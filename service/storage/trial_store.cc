#include "service/storage/trial_store.h"

#include <cstdint>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/error.h"
#include "service/storage/clock.h"
#include "service/storage/ids.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

constexpr const char* kAddBlob =
    "INSERT INTO blobs (sha256, size, bytes) VALUES (?1, ?2, ?3) ON CONFLICT DO NOTHING";
constexpr const char* kAddFile =
    "INSERT INTO trial_files (trial_id, part, name, sha256) VALUES (?1, ?2, ?3, ?4)";
constexpr const char* kAddTrial =
    "INSERT INTO trials (id, created_at, mass_kg, height_m, marker_set, options, understood, "
    "warnings) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
constexpr const char* kFindTrial =
    "SELECT created_at, mass_kg, height_m, marker_set, options, understood, warnings "
    "FROM trials WHERE id = ?1";
constexpr const char* kReadFiles =
    "SELECT part, name, bytes, sha256 FROM trial_files JOIN blobs USING (sha256) "
    "WHERE trial_id = ?1";

void addTrial(Connection& db, const api::TrialView& trial) {
  db.prepare(kAddTrial)
      .bind(1, trial.id)
      .bind(2, trial.created_at)
      .bind(3, trial.subject.mass)
      .bind(4, trial.subject.height)
      .bind(5, trial.subject.marker_set)
      .bind(6, trial.subject.options)
      .bind(7, api::encodeUnderstoodFiles(trial.files))
      .bind(8, api::dumpJson(trial.warnings))
      .run();
}

void addFile(Connection& db,
             const std::string& trial_id,
             const api::UnderstoodFile& file,
             const std::string& bytes) {
  db.prepare(kAddBlob).bind(1, file.sha256).bind(2, file.size).bindBytes(3, bytes).run();
  db.prepare(kAddFile)
      .bind(1, trial_id)
      .bind(2, file.part)
      .bind(3, file.name)
      .bind(4, file.sha256)
      .run();
}

}  // namespace

api::TrialView TrialStore::add(const api::TrialUpload& upload, api::TrialView view) {
  view.id = makeId("tri_");
  view.created_at = nowMilliseconds();
  view.subject = upload.subject;
  for (api::UnderstoodFile& file : view.files) {
    const std::string& bytes = upload.files.at(file.part).bytes;
    file.size = static_cast<std::int64_t>(bytes.size());
    file.sha256 = calcSha256(bytes);
  }
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  addTrial(db, view);
  for (const api::UnderstoodFile& file : view.files) {
    addFile(db, view.id, file, upload.files.at(file.part).bytes);
  }
  transaction.commit();
  return view;
}

api::TrialView TrialStore::find(const std::string& trial_id) {
  Statement row = database_.connection().prepare(kFindTrial);
  require(row.bind(1, trial_id).step(),
          ErrorCode::kTrialNotFound,
          "there is no trial '" + trial_id + "'",
          {"", 0, 0, trial_id});
  api::TrialView trial;
  trial.id = trial_id;
  trial.created_at = row.integer(0);
  trial.subject.mass = row.real(1);
  trial.subject.height = row.real(2);
  trial.subject.marker_set = row.optionalText(3);
  trial.subject.options = row.text(4);
  trial.files = api::decodeUnderstoodFiles(row.text(5));
  trial.warnings = nlohmann::json::parse(row.text(6)).get<std::vector<std::string>>();
  return trial;
}

api::TrialSubject TrialStore::findSubject(const std::string& trial_id) {
  return find(trial_id).subject;
}

std::map<std::string, api::UploadedFile> TrialStore::readFiles(const std::string& trial_id) {
  std::map<std::string, api::UploadedFile> files;
  Statement rows = database_.connection().prepare(kReadFiles);
  rows.bind(1, trial_id);
  while (rows.step()) {
    api::UploadedFile file{rows.text(1), rows.bytes(2)};
    require(calcSha256(file.bytes) == rows.text(3),
            ErrorCode::kStorage,
            "stored bytes do not have their hash any more",
            {file.name, 0, 0, rows.text(0)});
    files.emplace(rows.text(0), std::move(file));
  }
  return files;
}

}  // namespace gaitmill
