// Trials: what was measured.

#include <algorithm>
#include <cstdint>
#include <utility>

#include "api/digest.h"
#include "api/dto/trial.h"
#include "api/idempotency.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

constexpr std::uint64_t kMaxSubjectBytes = 1U << 20U;

std::string listParts() {
  std::string list;
  for (const std::string& part : trialParts()) {
    list += (list.empty() ? "" : ", ") + part;
  }
  return list;
}

void requirePart(const std::string& part, ErrorCode code) {
  const auto& known = trialParts();
  require(std::find(known.begin(), known.end(), part) != known.end(),
          code,
          "there is no part of this name; files are " + listParts(),
          {"", 0, 0, part.substr(0, 100)});
}

void requireFirst(bool is_first, const std::string& part) {
  require(
      is_first, ErrorCode::kRequestField, "part '" + part + "' is there twice", {"", 0, 0, part});
}

TrialUpload readParts(const HttpRequest& request) {
  TrialUpload upload;
  bool has_subject = false;
  for (const BodyPart& part : request.parts) {
    if (part.name == "trial") {
      requireFirst(!std::exchange(has_subject, true), part.name);
      upload.subject = parseTrialSubject(readAll(*part.bytes, kMaxSubjectBytes));
      continue;
    }
    requirePart(part.name, ErrorCode::kRequestField);
    const UploadedFile file{makeLabel(part.file_name, part.name), part.bytes};
    requireFirst(upload.files.emplace(part.name, file).second, part.name);
  }
  require(has_subject,
          ErrorCode::kRequestField,
          "part 'trial' with mass_kg and height_m is missing",
          {"", 0, 0, "trial"});
  return upload;
}

TrialUpload readUpload(const HttpRequest& request) {
  checkContentDigest(request);
  if (request.header("content-type").rfind("multipart/", 0) == 0) {
    return readParts(request);
  }
  TrialUpload upload;
  upload.subject = parseTrialSubject(bodyText(request));
  return upload;
}

bool isDryRun(const HttpRequest& request) {
  const auto found = request.query.find("validate");
  require(found == request.query.end() || found->second == "only",
          ErrorCode::kRequestField,
          "the only value is 'only': says what would be understood and stores nothing",
          {"", 0, 0, "validate"});
  return found != request.query.end();
}

HttpReply submitTrial(TrialPort& trials, HttpRequest& request) {
  const bool is_dry_run = isDryRun(request);
  TrialUpload upload = readUpload(request);
  upload.submission_key = request.header("idempotency-key");
  if (is_dry_run) {
    return replyJson(200, renderTrial(trials.validate(request.identity, upload)));
  }
  const TrialView trial = trials.submit(request.identity, upload);
  return replyCreated(201, "/v1/trials/" + trial.id, renderTrial(trial));
}

const std::string& trialId(const HttpRequest& request) {
  return idOf(request, "tri_", ErrorCode::kTrialNotFound);
}

HttpReply listTrials(TrialPort& trials, HttpRequest& request) {
  const ListFilter filter = readFilter(request);
  return replyPage(trials.list(request.identity, filter, readPage(request, "tri_")), renderTrial);
}

HttpReply findTrial(TrialPort& trials, HttpRequest& request) {
  return replyTagged(renderTrial(trials.find(request.identity, trialId(request))));
}

HttpReply removeTrial(TrialPort& trials, HttpRequest& request) {
  trials.remove(request.identity, trialId(request));
  return replyNothing();
}

HttpReply putTrialFile(TrialPort& trials, HttpRequest& request) {
  const std::string& part = request.captures.at("part");
  requirePart(part, ErrorCode::kRequestNotFound);
  checkContentDigest(request);
  const std::string name = findSentName(request);
  const UploadedFile file{name.empty() ? part : name, request.body};
  return replyJson(200,
                   renderTrial(trials.putFile(request.identity, trialId(request), part, file)));
}

HttpReply findTrialFile(TrialPort& trials, HttpRequest& request) {
  const std::string& part = request.captures.at("part");
  requirePart(part, ErrorCode::kResultNotFound);
  return replyFile(trials.findFile(request.identity, trialId(request), part),
                   "application/octet-stream");
}

}  // namespace

Routes makeTrialRoutes(const Ports& ports) {
  TrialPort& trials = ports.trials;
  const Handler submit = withIdempotency(ports.idempotency, on(trials, submitTrial, {"validate"}));
  const Names filters = {"limit", "cursor", "subject", "label", "created_after", "created_before"};
  const char* const file = "/v1/trials/{id}/files/{part}";
  return {
      {"POST", "/v1/trials", BodyKind::kMultipartOrJson, submit, Scope::kWrite},
      {"GET", "/v1/trials", BodyKind::kNone, on(trials, listTrials, filters), Scope::kRead},
      {"GET", "/v1/trials/{id}", BodyKind::kNone, on(trials, findTrial), Scope::kRead},
      {"DELETE", "/v1/trials/{id}", BodyKind::kNone, on(trials, removeTrial), Scope::kWrite},
      {"PUT", file, BodyKind::kBytes, on(trials, putTrialFile, {"name"}), Scope::kWrite},
      {"GET", file, BodyKind::kNone, on(trials, findTrialFile), Scope::kRead},
  };
}

}  // namespace gaitmill::api
