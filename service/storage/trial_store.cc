#include "service/storage/trial_store.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/error.h"
#include "service/storage/blob_store.h"
#include "service/storage/ids.h"
#include "service/storage/list_query.h"
#include "service/storage/sql/trials.h"
#include "service/storage/usage_rows.h"

namespace gaitmill {

namespace {

constexpr const char* kPrefix = "tri_";

Error notFound(const std::string& trial_id) {
  return {ErrorCode::kTrialNotFound, "there is no trial '" + trial_id + "'", {"", 0, 0, "trial"}};
}

api::TrialView readView(const Statement& row) {
  api::TrialView trial;
  api::decodeUnderstanding(row.text(6), trial);
  trial.id = row.text(0);
  trial.created_at = row.integer(1);
  trial.subject.mass = row.real(2);
  trial.subject.height = row.real(3);
  trial.subject.marker_set = row.optionalText(4);
  trial.subject.options = row.text(5);
  trial.subject.subject = row.text(7);
  trial.subject.label = row.text(8);
  return trial;
}

std::optional<api::TrialView> findView(Connection& db,
                                       const std::string& tenant,
                                       const std::string& trial_id) {
  Statement row = db.prepare(sql::kFindTrial);
  return row.bind(1, trial_id).bind(2, tenant).step() ? std::optional(readView(row)) : std::nullopt;
}

void insertTrial(Connection& db,
                 const NewTrial& trial,
                 const api::TrialView& view,
                 std::int64_t bytes) {
  db.prepare(sql::kAddTrial)
      .bind(1, view.id)
      .bind(2, view.created_at)
      .bind(3, view.subject.mass)
      .bind(4, view.subject.height)
      .bind(5, view.subject.marker_set)
      .bind(6, view.subject.options)
      .bind(7, api::encodeUnderstanding(view))
      .bind(8, trial.tenant)
      .bind(9, trial.key_id)
      .bind(10, view.subject.subject)
      .bind(11, view.subject.label)
      .bind(12, bytes)
      .bind(13, trial.submission_key)
      .run();
}

std::optional<std::string> findSubmitted(Connection& db, const NewTrial& trial) {
  Statement row = db.prepare(sql::kFindTrialBySubmission);
  row.bind(1, trial.tenant).bind(2, trial.submission_key);
  return !trial.submission_key.empty() && row.step() ? std::optional(row.text(0)) : std::nullopt;
}

// One file of a trial with its bytes prepared.
struct IncomingFile {
  std::string part;
  std::string name;
  IncomingBlob blob;
};

bool attachFiles(Connection& db,
                 BlobStore& blobs,
                 const std::string& trial_id,
                 const std::vector<IncomingFile>& files) {
  for (const IncomingFile& file : files) {
    const std::optional<std::int64_t> blob_id = blobs.attach(db, file.blob);
    if (!blob_id) {
      return false;
    }
    db.prepare(sql::kPutTrialFile)
        .bind(1, trial_id)
        .bind(2, file.part)
        .bind(3, file.name)
        .bind(4, *blob_id)
        .run();
  }
  return true;
}

// Thrown through a write to undo it: the content went away after prepare() had found it.
struct ContentVanished {};

// Prepares the files, calls write(files) and, should content vanish in between, does both again.
template <class Write>
auto writeWithFiles(BlobStore& blobs,
                    const std::map<std::string, api::UploadedFile>& sources,
                    Write write) {
  while (true) {
    std::vector<IncomingFile> files;
    std::vector<IncomingBlob> staged;
    const auto discard = [&] {
      for (const IncomingFile& file : files) {
        if (file.blob.staged_id) {
          staged.push_back({{}, 0, {}, file.blob.staged_id});
        }
      }
      if (!staged.empty()) {
        blobs.discard(staged);
      }
    };
    try {
      for (const auto& [part, source] : sources) {
        files.push_back({part, source.name, blobs.prepare(*source.bytes)});
      }
      auto result = write(files);
      discard();  // what somebody else stored meanwhile
      return result;
    } catch (const ContentVanished&) {
      discard();
    } catch (...) {
      discard();
      throw;
    }
  }
}

void describeSizes(api::TrialView& view, const std::vector<IncomingFile>& files) {
  for (api::UnderstoodFile& understood : view.files) {
    for (const IncomingFile& file : files) {
      if (file.part == understood.part) {
        understood.size = file.blob.size;
        understood.sha256 = file.blob.sha256;
      }
    }
  }
}

std::int64_t sumSizes(const std::vector<IncomingFile>& files) {
  std::int64_t size = 0;
  for (const IncomingFile& file : files) {
    size += file.blob.size;
  }
  return size;
}

struct TrialOwner {
  std::string key_id;
  std::int64_t bytes;
};

// Within a write: the trial must be the tenant's and free of jobs.
TrialOwner requireUnused(Connection& db, const std::string& tenant, const std::string& trial_id) {
  TrialOwner owner;
  {
    Statement row = db.prepare(sql::kFindTrialOwner);
    if (!row.bind(1, trial_id).bind(2, tenant).step()) {
      throw notFound(trial_id);
    }
    owner = {row.text(0), row.integer(1)};
  }
  require(!db.prepare(sql::kTrialHasJobs).bind(1, trial_id).step(),
          ErrorCode::kTrialInUse,
          "jobs refer to the trial '" + trial_id + "'; delete them first",
          {"", 0, 0, "trial"});
  return owner;
}

struct StoredFile {
  std::int64_t blob_id;
  std::int64_t size;
};

std::optional<StoredFile> findStored(Connection& db,
                                     const std::string& trial_id,
                                     const std::string& part) {
  Statement row = db.prepare(sql::kFindTrialFile);
  return row.bind(1, trial_id).bind(2, part).step()
             ? std::optional(StoredFile{row.integer(1), row.integer(2)})
             : std::nullopt;
}

std::vector<std::int64_t> listBlobs(Connection& db, const std::string& trial_id) {
  std::vector<std::int64_t> ids;
  Statement rows = db.prepare(sql::kListTrialFiles);
  rows.bind(1, trial_id);
  while (rows.step()) {
    ids.push_back(rows.integer(2));
  }
  return ids;
}

// In the order in which parts are shown.
void putUnderstood(api::TrialView& view, const api::UnderstoodFile& understood) {
  const auto same = [&understood](const api::UnderstoodFile& file) {
    return file.part == understood.part;
  };
  view.files.erase(std::remove_if(view.files.begin(), view.files.end(), same), view.files.end());
  view.files.push_back(understood);
  const auto rank = [](const api::UnderstoodFile& file) {
    const auto& parts = api::trialParts();
    return std::find(parts.begin(), parts.end(), file.part);
  };
  std::stable_sort(view.files.begin(), view.files.end(), [&rank](const auto& a, const auto& b) {
    return rank(a) < rank(b);
  });
}

}  // namespace

api::TrialView TrialStore::add(const NewTrial& trial, const Quota& quota) {
  BlobStore blobs(database_);
  const auto write = [&](const std::vector<IncomingFile>& files) {
    return database_.write([&](Connection& db) {
      if (const auto earlier = findSubmitted(db, trial)) {
        return findView(db, trial.tenant, *earlier).value();
      }
      api::TrialView view = trial.understanding;
      view.id = makeId(kPrefix);
      view.created_at = findTimeOfId(view.id);
      view.subject = trial.subject;
      describeSizes(view, files);
      const std::int64_t bytes = sumSizes(files);
      insertTrial(db, trial, view, bytes);
      if (!attachFiles(db, blobs, view.id, files)) {
        throw ContentVanished();
      }
      chargeUsage(db, trial.tenant, trial.key_id, {bytes, 1, 0, 0, 0}, quota);
      return view;
    });
  };
  return writeWithFiles(blobs, trial.files, write);
}

api::TrialView TrialStore::putFile(const std::string& tenant,
                                   const std::string& trial_id,
                                   const api::UploadedFile& file,
                                   const api::UnderstoodFile& understood,
                                   const TrialUpdate& update,
                                   const Quota& quota) {
  BlobStore blobs(database_);
  std::vector<std::int64_t> unused;
  const auto write = [&](const std::vector<IncomingFile>& files) {
    return database_.write([&](Connection& db) {
      const TrialOwner owner = requireUnused(db, tenant, trial_id);
      api::TrialView view = findView(db, tenant, trial_id).value();
      const std::optional<StoredFile> old = findStored(db, trial_id, understood.part);
      putUnderstood(view, understood);
      describeSizes(view, files);
      update(view);
      if (!attachFiles(db, blobs, trial_id, files)) {
        throw ContentVanished();
      }
      if (old) {
        const auto released = blobs.release(db, old->blob_id);
        unused.assign(released ? 1 : 0, released.value_or(0));
      }
      const std::int64_t growth = sumSizes(files) - (old ? old->size : 0);
      db.prepare(sql::kChangeTrial)
          .bind(1, trial_id)
          .bind(2, api::encodeUnderstanding(view))
          .bind(3, growth)
          .run();
      chargeUsage(db, tenant, owner.key_id, {growth, 0, 0, 0, 0}, quota);
      return view;
    });
  };
  const bool replaces = findStored(*database_.read(), trial_id, understood.part).has_value();
  const api::TrialView view = writeWithFiles(blobs, {{understood.part, file}}, write);
  blobs.purge(unused);
  if (replaces) {
    database_.wipeDeleted();
  }
  return view;
}

api::TrialView TrialStore::find(const std::string& tenant, const std::string& trial_id) {
  const std::optional<api::TrialView> view = findView(*database_.read(), tenant, trial_id);
  if (!view) {
    throw notFound(trial_id);
  }
  return *view;
}

api::TrialSubject TrialStore::findSubject(const std::string& tenant, const std::string& trial_id) {
  return find(tenant, trial_id).subject;
}

api::Page<api::TrialView> TrialStore::list(const std::string& tenant,
                                           const api::ListFilter& filter,
                                           const api::PageRequest& page) {
  ListQuery query(sql::kSelectTrials, tenant, kPrefix);
  query.whereNonEmpty("subject", filter.subject)
      .whereNonEmpty("label", filter.label)
      .between(filter.created_after, filter.created_before)
      .page(page);
  std::vector<api::TrialView> views;
  const ReadTransaction db = database_.read();
  Statement rows = query.run(*db);
  while (rows.step()) {
    views.push_back(readView(rows));
  }
  return makePage(std::move(views), page);
}

api::FileContent TrialStore::readFile(const std::string& tenant,
                                      const std::string& trial_id,
                                      const std::string& part) {
  const ReadTransaction db = database_.read();
  if (!db->prepare(sql::kFindTrialOwner).bind(1, trial_id).bind(2, tenant).step()) {
    throw notFound(trial_id);
  }
  Statement row = db->prepare(sql::kFindTrialFile);
  require(row.bind(1, trial_id).bind(2, part).step(),
          ErrorCode::kResultNotFound,
          "the trial '" + trial_id + "' has no file '" + part + "'",
          {"", 0, 0, part});
  return {{row.text(0), row.integer(2), row.text(3)},
          BlobStore(database_).open(row.integer(1), row.integer(2))};
}

std::map<std::string, api::UploadedFile> TrialStore::readFiles(const std::string& tenant,
                                                               const std::string& trial_id) {
  std::map<std::string, api::UploadedFile> files;
  const ReadTransaction db = database_.read();
  if (!db->prepare(sql::kFindTrialOwner).bind(1, trial_id).bind(2, tenant).step()) {
    throw notFound(trial_id);
  }
  Statement rows = db->prepare(sql::kListTrialFiles);
  rows.bind(1, trial_id);
  BlobStore blobs(database_);
  while (rows.step()) {
    files[rows.text(0)] = {rows.text(1), blobs.open(rows.integer(2), rows.integer(3))};
  }
  return files;
}

void TrialStore::remove(const std::string& tenant, const std::string& trial_id) {
  BlobStore blobs(database_);
  std::vector<std::int64_t> unused;
  database_.write([&](Connection& db) {
    const TrialOwner owner = requireUnused(db, tenant, trial_id);
    const std::vector<std::int64_t> released = listBlobs(db, trial_id);
    db.prepare(sql::kDropTrial).bind(1, trial_id).run();
    for (const std::int64_t id : released) {
      if (const auto last = blobs.release(db, id)) {
        unused.push_back(*last);
      }
    }
    chargeUsage(db, tenant, owner.key_id, {-owner.bytes, -1, 0, 0, 0});
  });
  blobs.purge(unused);
  database_.wipeDeleted();
}

std::vector<OwnedId> TrialStore::listUnused(std::int64_t time, int limit) {
  std::vector<OwnedId> trials;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kListUnusedTrials);
  rows.bind(1, makeIdBound(kPrefix, time)).bind(2, std::int64_t{limit});
  while (rows.step()) {
    trials.push_back({rows.text(0), rows.text(1)});
  }
  return trials;
}

int TrialStore::removeUnfinishedUploads() {
  BlobStore blobs(database_);
  const std::vector<std::int64_t> unused = blobs.listUnused();
  blobs.purge(unused);
  return static_cast<int>(unused.size());
}

}  // namespace gaitmill
