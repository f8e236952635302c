#include "service/inspection_process.h"

#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "service/process/conversation.h"
#include "service/process/item_sender.h"
#include "service/process/messages.h"

namespace gaitmill {

namespace {

using Clock = Conversation::Clock;

std::uint64_t countBytes(const api::TrialUpload& upload) {
  std::uint64_t bytes = 0;
  for (const auto& [part, file] : upload.files) {
    bytes += file.bytes->size();
  }
  return bytes;
}

ItemSender makeSpeech(const api::TrialUpload& upload) {
  ItemSender speech;
  speech.add(makeFrame(Message::kSubject,
                       {packDouble(upload.subject.mass), packDouble(upload.subject.height)}));
  for (const auto& [part, file] : upload.files) {
    const auto read = [source = file.bytes](std::uint64_t offset, std::size_t size) {
      return source->read(offset, size);
    };
    speech.add(makeFrame(Message::kPart, {part, file.name}), file.bytes->size(), read);
  }
  speech.add(makeFrame(Message::kGo));
  return speech;
}

struct Answer {
  std::string understanding;
  std::vector<std::string> warnings;
  std::optional<Error> error;
};

bool hear(Frame&& frame, Answer& answer) {
  switch (messageOf(frame)) {
    case Message::kUnderstood:
      answer.warnings = std::move(frame.fields);
      return true;
    case Message::kData:
      answer.understanding += fieldOf(frame, 0);
      return true;
    case Message::kDone:
      return false;
    case Message::kError:
      answer.error = readErrorFrame(frame);
      return false;
    case Message::kOutOfMemory:
      answer.error =
          Error(ErrorCode::kFileTooLarge, "reading these files takes more memory than there is");
      return false;
    default:
      throw Error(ErrorCode::kJobCrashed, "an inspection says what only a solver says");
  }
}

Answer inspectInChild(const ChildCommand& command,
                      const api::TrialUpload& upload,
                      const InspectionLimits& limits) {
  ItemSender speech = makeSpeech(upload);
  Answer answer;
  const Clock::time_point deadline = Clock::now() + limits.silence;
  const Child child(command, limits.child);
  Conversation conversation;
  conversation.speak = [&] {
    return speech.next();
  };
  conversation.hear = [&](Frame&& frame) {
    return hear(std::move(frame), answer);
  };
  conversation.go_on = [] {
    return true;
  };
  conversation.deadline = [&] {
    return deadline;
  };
  require(converse(child, conversation) == ConversationEnd::kComplete,
          ErrorCode::kFileFormat,
          "these files cannot be read: the process that read them did not come to an end",
          {"", 0, 0, upload.files.begin()->first});
  return answer;
}

}  // namespace

TrialInspector inspectLargeInChild(ChildCommand command,
                                   TrialInspector in_process,
                                   InspectionLimits limits) {
  return [command = std::move(command), in_process = std::move(in_process), limits](
             const api::TrialUpload& upload) {
    if (countBytes(upload) <= limits.in_process) {
      return in_process(upload);
    }
    Answer answer = inspectInChild(command, upload, limits);
    if (answer.error) {
      throw Error(*answer.error);
    }
    api::TrialView view;
    view.subject = upload.subject;
    api::decodeUnderstanding(answer.understanding, view);
    view.warnings = std::move(answer.warnings);
    return view;
  };
}

}  // namespace gaitmill
