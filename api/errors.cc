#include "api/errors.h"

#include "api/dto/error_body.h"

namespace gaitmill::api {

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
    case ErrorCode::kFileEmpty:
    case ErrorCode::kFileNotTheData:
    case ErrorCode::kFileFormat:
    case ErrorCode::kTrcHeader:
    case ErrorCode::kTrcUnits:
    case ErrorCode::kTrcMarkerNames:
    case ErrorCode::kTrcDuplicateMarker:
    case ErrorCode::kTrcColumnCount:
    case ErrorCode::kTrcNumber:
    case ErrorCode::kTrcTimeOrder:
    case ErrorCode::kTrcNoRows:
    case ErrorCode::kTableHeader:
    case ErrorCode::kTableLabels:
    case ErrorCode::kTableDuplicateLabel:
    case ErrorCode::kTableColumnCount:
    case ErrorCode::kTableNumber:
    case ErrorCode::kTableTimeOrder:
    case ErrorCode::kTableNoRows:
    case ErrorCode::kTableUnknownLabel:
    case ErrorCode::kTableShape:
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

HttpReply replyError(const Error& error) {
  HttpReply reply;
  reply.status = httpStatus(error.code());
  reply.body = renderError(error);
  return reply;
}

}  // namespace gaitmill::api
