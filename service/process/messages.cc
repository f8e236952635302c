#include "service/process/messages.h"

#include <cstring>
#include <utility>

namespace gaitmill {

namespace {

// Members of an error frame, then its context.
enum ErrorField : std::size_t {
  kCode,
  kSentence,
  kFile,
  kLine,
  kColumn,
  kField,
  kStage,
  kTime,
  kMarker,
  kMuscle,
  kCoordinate,
  kFirstContext,
};

ErrorCode findCode(const std::string& name) {
  for (const ErrorCode code : allErrorCodes()) {
    if (codeName(code) == name) {
      return code;
    }
  }
  throw Error(ErrorCode::kJobCrashed, "a child reports an error that does not exist");
}

int unpackCount(const std::string& bytes) {
  const double value = unpackDouble(bytes);
  return value > 0 && value < 2e9 ? static_cast<int>(value) : 0;
}

}  // namespace

Frame makeFrame(Message message, std::vector<std::string> fields) {
  return {static_cast<std::uint8_t>(message), std::move(fields)};
}

Message messageOf(const Frame& frame) {
  return static_cast<Message>(frame.kind);
}

std::string packDouble(double value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

double unpackDouble(const std::string& bytes) {
  double value = 0;
  require(bytes.size() == sizeof value, ErrorCode::kJobCrashed, "a child sends no number");
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

Frame makeErrorFrame(const Error& error) {
  const Where& where = error.where();
  std::vector<std::string> fields = {std::string(codeName(error.code())),
                                     error.message(),
                                     where.file,
                                     packDouble(where.line),
                                     packDouble(where.column),
                                     where.field,
                                     where.stage,
                                     packDouble(where.time),
                                     where.marker,
                                     where.muscle,
                                     where.coordinate};
  fields.insert(fields.end(), error.context().begin(), error.context().end());
  return makeFrame(Message::kError, std::move(fields));
}

Error readErrorFrame(const Frame& frame) {
  Where where;
  where.file = fieldOf(frame, kFile);
  where.line = unpackCount(fieldOf(frame, kLine));
  where.column = unpackCount(fieldOf(frame, kColumn));
  where.field = fieldOf(frame, kField);
  where.stage = fieldOf(frame, kStage);
  where.time = unpackDouble(fieldOf(frame, kTime));
  where.marker = fieldOf(frame, kMarker);
  where.muscle = fieldOf(frame, kMuscle);
  where.coordinate = fieldOf(frame, kCoordinate);
  Error error(findCode(fieldOf(frame, kCode)), fieldOf(frame, kSentence), where);
  for (std::size_t i = kFirstContext; i < frame.fields.size(); ++i) {
    error.addContext(frame.fields[i]);
  }
  return error;
}

const std::string& fieldOf(const Frame& frame, std::size_t number) {
  require(number < frame.fields.size(),
          ErrorCode::kJobCrashed,
          "a message of a child has too few members");
  return frame.fields[number];
}

}  // namespace gaitmill
