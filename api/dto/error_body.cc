#include "api/dto/error_body.h"

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

bool isOurFault(ErrorCode code) {
  return code == ErrorCode::kInternal || code == ErrorCode::kStorage;
}

json toJson(const Where& where) {
  json object = json::object();
  if (!where.file.empty()) {
    object["file"] = where.file;
  }
  if (where.line > 0) {
    object["line"] = where.line;
  }
  if (where.column > 0) {
    object["column"] = where.column;
  }
  if (!where.field.empty()) {
    object["field"] = where.field;
  }
  return object;
}

json toJson(const Error& error) {
  return {{"code", codeName(error.code())},
          {"message",
           isOurFault(error.code()) ? "the service failed here; its log has the details"
                                    : error.message()},
          {"where", toJson(error.where())},
          {"context", error.context()}};
}

}  // namespace

std::string renderError(const Error& error) {
  return dumpJson({{"error", toJson(error)}});
}

std::string renderErrorObject(const Error& error) {
  return dumpJson(toJson(error));
}

}  // namespace gaitmill::api
