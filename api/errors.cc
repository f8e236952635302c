#include "api/errors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

// Time after which a refused request may be sent again, as Retry-After.
constexpr const char* kRetrySeconds = "2";

// What went wrong on this machine is for its operator; what went wrong in a job is for its owner.
bool isOurFault(ErrorCode code) {
  static const std::vector<ErrorCode> of_jobs = {ErrorCode::kJobAbandoned,
                                                 ErrorCode::kJobCrashed,
                                                 ErrorCode::kJobTimeout,
                                                 ErrorCode::kJobMemory};
  return httpStatus(code) == 500 &&
         std::find(of_jobs.begin(), of_jobs.end(), code) == of_jobs.end();
}

// Where to look when whoever found the error did not say: the part of the request that its code is
// about, else the group of the code ("trc", "settings").
std::string findUsualPlace(ErrorCode code) {
  static const std::vector<std::pair<ErrorCode, const char*>> places = {
      {ErrorCode::kRequestMalformed, "request"},
      {ErrorCode::kRequestField, "request"},
      {ErrorCode::kRequestNotFound, "path"},
      {ErrorCode::kRequestMethod, "method"},
      {ErrorCode::kRequestNotAcceptable, "Accept"},
      {ErrorCode::kRequestTooLarge, "Content-Length"},
      {ErrorCode::kRequestLengthRequired, "Content-Length"},
      {ErrorCode::kRequestUriTooLong, "path"},
      {ErrorCode::kRequestMediaType, "Content-Type"},
      {ErrorCode::kRequestDigest, "Content-Digest"},
      {ErrorCode::kRequestRange, "Range"},
      {ErrorCode::kRequestBusy, "service"},
      {ErrorCode::kRequestRate, "service"},
      {ErrorCode::kRequestTimeout, "body"},
      {ErrorCode::kUnauthorized, "Authorization"},
      {ErrorCode::kForbidden, "Authorization"},
      {ErrorCode::kIdempotencyMismatch, "Idempotency-Key"},
      {ErrorCode::kIdempotencyBusy, "Idempotency-Key"},
      {ErrorCode::kTrialNotFound, "id"},
      {ErrorCode::kJobNotFound, "id"},
      {ErrorCode::kStudyNotFound, "id"},
      {ErrorCode::kModelNotFound, "id"},
      {ErrorCode::kMarkerSetNotFound, "id"},
      {ErrorCode::kSettingsNotFound, "name"},
      {ErrorCode::kKeyNotFound, "id"},
      {ErrorCode::kResultNotFound, "name"},
      {ErrorCode::kFigureNotFound, "name"},
      {ErrorCode::kImageSize, "width"},
      {ErrorCode::kResultNotReady, "name"},
      {ErrorCode::kJobState, "state"},
  };
  const auto found = std::find_if(
      places.begin(), places.end(), [&](const auto& place) { return place.first == code; });
  const std::string_view name = codeName(code);
  return found == places.end() ? std::string(name.substr(0, name.find('.'))) : found->second;
}

void putText(json& object, const char* key, const std::string& text) {
  if (!text.empty()) {
    object[key] = text;
  }
}

json renderWhere(const Where& where, ErrorCode code) {
  if (isOurFault(code)) {
    return {{"field", "service"}};
  }
  json object = json::object();
  putText(object, "file", where.file);
  if (where.line > 0) {
    object["line"] = where.line;
  }
  if (where.column > 0) {
    object["column"] = where.column;
  }
  putText(object, "field", where.field);
  putText(object, "stage", where.stage);
  if (std::isfinite(where.time)) {
    object["time_s"] = where.time;
  }
  putText(object, "marker", where.marker);
  putText(object, "muscle", where.muscle);
  putText(object, "coordinate", where.coordinate);
  return object.empty() ? json{{"field", findUsualPlace(code)}} : object;
}

// The parts of a model that cannot be simulated, from the lines "line N: element: reason" of the
// message, which passes between processes as it is.
json listUnsupported(const std::string& message) {
  constexpr std::string_view kPrefix = "line ";
  json list = json::array();
  std::size_t at = message.find('\n');
  while (at != std::string::npos) {
    const std::size_t end = std::min(message.find('\n', at + 1), message.size());
    const std::string line = message.substr(at + 1, end - at - 1);
    const std::size_t number_end = line.find(": ");
    const std::size_t element_end = line.find(": ", number_end + 2);
    if (line.rfind(kPrefix, 0) == 0 && element_end != std::string::npos) {
      list.push_back({{"line", std::atoi(line.c_str() + kPrefix.size())},
                      {"element", line.substr(number_end + 2, element_end - number_end - 2)},
                      {"reason", line.substr(element_end + 2)}});
    }
    at = end == message.size() ? std::string::npos : end;
  }
  return list;
}

json makeProblem(const Error& error) {
  const ErrorCode code = error.code();
  const bool is_ours = isOurFault(code);
  json problem = {
      {"type", "/problems/" + std::string(codeName(code))},
      {"title", problemTitle(code)},
      {"status", httpStatus(code)},
      {"detail", is_ours ? "the service failed here; its log has the details" : error.message()},
      {"code", codeName(code)},
      {"where", renderWhere(error.where(), code)},
      {"fix", codeFix(code)},
      {"context", is_ours ? std::vector<std::string>{} : error.context()}};
  if (code == ErrorCode::kModelUnsupported) {
    json list = listUnsupported(error.message());
    if (!list.empty()) {
      problem["unsupported"] = std::move(list);
    }
  }
  return problem;
}

}  // namespace

// 422 = the request is well formed but its content is not: everything a parser or a stage finds in
// what was uploaded. No `default`, so that the compiler asks for the status of a new code.
// NOLINTNEXTLINE(readability-function-size): one line per code is the table itself
int httpStatus(ErrorCode code) {
  switch (code) {
    case ErrorCode::kRequestMalformed:
    case ErrorCode::kRequestDigest:
    case ErrorCode::kUsage:
      return 400;
    case ErrorCode::kUnauthorized:
      return 401;
    case ErrorCode::kForbidden:
      return 403;
    case ErrorCode::kRequestNotFound:
    case ErrorCode::kTrialNotFound:
    case ErrorCode::kJobNotFound:
    case ErrorCode::kStudyNotFound:
    case ErrorCode::kModelNotFound:
    case ErrorCode::kMarkerSetNotFound:
    case ErrorCode::kSettingsNotFound:
    case ErrorCode::kKeyNotFound:
    case ErrorCode::kResultNotFound:
    case ErrorCode::kFigureNotFound:
      return 404;
    case ErrorCode::kRequestMethod:
      return 405;
    case ErrorCode::kRequestNotAcceptable:
      return 406;
    case ErrorCode::kRequestTimeout:
      return 408;
    case ErrorCode::kJobState:
    case ErrorCode::kTrialInUse:
    case ErrorCode::kCatalogInUse:
    case ErrorCode::kIdempotencyBusy:
    case ErrorCode::kResultNotReady:
    case ErrorCode::kCancelled:
      return 409;
    case ErrorCode::kRequestLengthRequired:
      return 411;
    case ErrorCode::kFileTooLarge:
    case ErrorCode::kRequestTooLarge:
      return 413;
    case ErrorCode::kRequestUriTooLong:
      return 414;
    case ErrorCode::kRequestMediaType:
      return 415;
    case ErrorCode::kRequestRange:
      return 416;
    case ErrorCode::kRequestHeadersTooLarge:
      return 431;
    case ErrorCode::kImageSize:
    case ErrorCode::kMeshFormat:
    case ErrorCode::kFileEmpty:
    case ErrorCode::kFileNotTheData:
    case ErrorCode::kFileFormat:
    case ErrorCode::kTrcHeader:
    case ErrorCode::kTrcUnits:
    case ErrorCode::kTrcMarkerNames:
    case ErrorCode::kMarkerNames:
    case ErrorCode::kMarkersMissing:
    case ErrorCode::kTrcDuplicateMarker:
    case ErrorCode::kTrcColumnCount:
    case ErrorCode::kTrcNumber:
    case ErrorCode::kTrcTimeOrder:
    case ErrorCode::kTrcNoRows:
    case ErrorCode::kC3dHeader:
    case ErrorCode::kC3dData:
    case ErrorCode::kTableHeader:
    case ErrorCode::kTableLabels:
    case ErrorCode::kTableDuplicateLabel:
    case ErrorCode::kTableColumnCount:
    case ErrorCode::kTableNumber:
    case ErrorCode::kTableTimeOrder:
    case ErrorCode::kTableNoRows:
    case ErrorCode::kTableUnknownLabel:
    case ErrorCode::kTableShape:
    case ErrorCode::kEmgHeader:
    case ErrorCode::kEmgChannels:
    case ErrorCode::kGrfColumns:
    case ErrorCode::kGrfUnits:
    case ErrorCode::kGrfValue:
    case ErrorCode::kModelXml:
    case ErrorCode::kModelVersion:
    case ErrorCode::kModelElement:
    case ErrorCode::kModelValue:
    case ErrorCode::kModelReference:
    case ErrorCode::kModelDuplicateName:
    case ErrorCode::kModelTopology:
    case ErrorCode::kModelUnsupported:
    case ErrorCode::kMuscleParameter:
    case ErrorCode::kSettingsJson:
    case ErrorCode::kSettingsUnknownField:
    case ErrorCode::kSettingsValue:
    case ErrorCode::kInputMissing:
    case ErrorCode::kInputMarkers:
    case ErrorCode::kInputCoordinates:
    case ErrorCode::kInputAmbiguous:
    case ErrorCode::kInputTimeRange:
    case ErrorCode::kInputValue:
    case ErrorCode::kRequestField:
    case ErrorCode::kIdempotencyMismatch:
      return 422;
    case ErrorCode::kQuotaExceeded:
    case ErrorCode::kRequestRate:
      return 429;
    case ErrorCode::kFileNotFound:
    case ErrorCode::kFileUnreadable:
    case ErrorCode::kFileUnwritable:
    case ErrorCode::kJobAbandoned:
    case ErrorCode::kJobCrashed:
    case ErrorCode::kCheckpointUnusable:
    case ErrorCode::kJobTimeout:
    case ErrorCode::kJobMemory:
    case ErrorCode::kConfig:
    case ErrorCode::kStorage:
    case ErrorCode::kStorageVersion:
    case ErrorCode::kStorageInUse:
    case ErrorCode::kServicePort:
    case ErrorCode::kRender:
    case ErrorCode::kInternal:
      return 500;
    case ErrorCode::kRequestBusy:
    case ErrorCode::kServiceUnready:
      return 503;
    case ErrorCode::kStorageFull:
      return 507;
  }
  return 500;
}

std::string problemTitle(ErrorCode code) {
  static const std::vector<std::string> abbreviations = {"trc", "grf", "json", "xml", "uri"};
  std::string title;
  std::string word;
  const auto end_word = [&] {
    if (std::find(abbreviations.begin(), abbreviations.end(), word) != abbreviations.end()) {
      std::transform(word.begin(), word.end(), word.begin(), [](unsigned char letter) {
        return static_cast<char>(std::toupper(letter));
      });
    }
    title += (title.empty() ? "" : " ") + std::exchange(word, "");
  };
  for (const char letter : codeName(code)) {
    if (letter == '.' || letter == '_') {
      end_word();
    } else {
      word += letter;
    }
  }
  end_word();
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  return title;
}

std::string renderProblem(const Error& error, const std::string& request_id) {
  json problem = makeProblem(error);
  if (!request_id.empty()) {
    problem["instance"] = "urn:gaitmill:request:" + request_id;
  }
  return dumpJson(problem);
}

std::string renderProblemObject(const Error& error) {
  return dumpJson(makeProblem(error));
}

HttpReply replyError(const Error& error, const std::string& request_id) {
  HttpReply reply;
  reply.status = httpStatus(error.code());
  reply.content_type = "application/problem+json";
  reply.body = renderProblem(error, request_id);
  if (reply.status == 401) {
    reply.headers["WWW-Authenticate"] = "Bearer realm=\"gaitmill\"";
  }
  if (reply.status == 403) {
    reply.headers["WWW-Authenticate"] = "Bearer realm=\"gaitmill\", error=\"insufficient_scope\"";
  }
  if (reply.status == 429 || reply.status == 503 || reply.status == 507 ||
      error.code() == ErrorCode::kIdempotencyBusy) {
    reply.headers["Retry-After"] = kRetrySeconds;
  }
  return reply;
}

std::string renderProblemType(const std::string& code) {
  for (const ErrorCode known : allErrorCodes()) {
    if (codeName(known) == code) {
      return dumpJson({{"type", "/problems/" + code},
                       {"title", problemTitle(known)},
                       {"status", httpStatus(known)},
                       {"code", code},
                       {"fix", codeFix(known)}});
    }
  }
  throw Error(ErrorCode::kRequestNotFound, "no problem has this code", {"", 0, 0, "code"});
}

}  // namespace gaitmill::api
