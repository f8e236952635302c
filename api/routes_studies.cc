// Studies: trials times settings, submitted and read as one.

#include "api/digest.h"
#include "api/dto/result.h"
#include "api/dto/study.h"
#include "api/idempotency.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

const std::string& studyId(const HttpRequest& request) {
  return idOf(request, "stu_", ErrorCode::kStudyNotFound);
}

HttpReply submitStudy(StudyPort& studies, HttpRequest& request) {
  checkContentDigest(request);
  StudyRequest wanted = parseStudyRequest(bodyText(request));
  wanted.submission_key = request.header("idempotency-key");
  const StudyView study = studies.submit(request.identity, wanted);
  return replyCreated(202, "/v1/studies/" + study.id, renderStudy(study));
}

HttpReply listStudies(StudyPort& studies, HttpRequest& request) {
  const ListFilter filter = readFilter(request);
  return replyPage(studies.list(request.identity, filter, readPage(request, "stu_")), renderStudy);
}

HttpReply findStudy(StudyPort& studies, HttpRequest& request) {
  const StudyView study = studies.find(request.identity, studyId(request));
  HttpReply reply = replyJson(200, renderStudy(study));
  reply.headers["ETag"] = "W/\"" + std::to_string(study.version) + "\"";
  return reply;
}

HttpReply cancelStudy(StudyPort& studies, HttpRequest& request) {
  return replyJson(202, renderStudy(studies.cancel(request.identity, studyId(request))));
}

HttpReply removeStudy(StudyPort& studies, HttpRequest& request) {
  studies.remove(request.identity, studyId(request));
  return replyNothing();
}

HttpReply findStudyTable(StudyPort& studies, HttpRequest& request) {
  const ResultFormat format = findResultFormat(queryOf(request, "format"),
                                               request.header("accept"),
                                               {ResultFormat::kJson, ResultFormat::kCsv});
  const std::vector<StudyRow> rows = studies.listRows(request.identity, studyId(request));
  HttpReply reply = replyTagged(format == ResultFormat::kCsv ? renderStudyTableCsv(rows)
                                                             : renderStudyTable(rows));
  reply.content_type = contentType(format);
  reply.headers["Vary"] = "Accept";
  return reply;
}

}  // namespace

Routes makeStudyRoutes(const Ports& ports) {
  StudyPort& studies = ports.studies;
  const Handler submit = withIdempotency(ports.idempotency, on(studies, submitStudy));
  const Handler list =
      on(studies, listStudies, {"limit", "cursor", "created_after", "created_before"});
  const Handler table = on(studies, findStudyTable, {"format"});
  return {
      {"POST", "/v1/studies", BodyKind::kJson, submit, Scope::kWrite},
      {"GET", "/v1/studies", BodyKind::kNone, list, Scope::kRead},
      {"GET", "/v1/studies/{id}", BodyKind::kNone, on(studies, findStudy), Scope::kRead},
      {"DELETE", "/v1/studies/{id}", BodyKind::kNone, on(studies, removeStudy), Scope::kWrite},
      {"POST", "/v1/studies/{id}/cancel", BodyKind::kNone, on(studies, cancelStudy), Scope::kWrite},
      {"GET", "/v1/studies/{id}/results", BodyKind::kNone, table, Scope::kRead},
  };
}

}  // namespace gaitmill::api
