#include "service/process/solver_process.h"

#include <algorithm>
#include <utility>

#include "service/process/item_sender.h"
#include "service/process/messages.h"

namespace gaitmill {

namespace {

using Clock = Conversation::Clock;

constexpr const char* kBeforeStages = "";  // while input is read

ItemSender makeSpeech(const SolveRequest& request) {
  ItemSender speech;
  speech.add(makeFrame(Message::kSubject, {packDouble(request.mass), packDouble(request.height)}));
  speech.add(makeFrame(Message::kSettings, {request.settings.name}),
             request.settings.bytes.size(),
             readFromMemory(request.settings.bytes));
  for (const auto& [part, file] : request.parts) {
    const auto read = [source = file.bytes](std::uint64_t offset, std::size_t size) {
      return source->read(offset, size);
    };
    speech.add(makeFrame(Message::kPart, {part, file.name}), file.bytes->size(), read);
  }
  for (const std::string& checkpoint : request.checkpoints) {
    speech.add(makeFrame(Message::kCheckpoint), checkpoint.size(), readFromMemory(checkpoint));
  }
  speech.add(makeFrame(Message::kGo));
  return speech;
}

Stage readStage(const std::string& name) {
  for (int i = 0; i < kStageCount; ++i) {
    if (name == stageName(static_cast<Stage>(i))) {
      return static_cast<Stage>(i);
    }
  }
  throw Error(ErrorCode::kJobCrashed, "a child speaks of a stage that does not exist");
}

SolvedItem::Kind readItemKind(const std::string& text) {
  using Kind = SolvedItem::Kind;
  for (const Kind kind : {Kind::kFile, Kind::kTime, Kind::kCycle, Kind::kSummary}) {
    if (text == std::string(1, static_cast<char>(kind))) {
      return kind;
    }
  }
  throw Error(ErrorCode::kJobCrashed, "a child sends a result of no kind");
}

// One job as its child tells of it.
class Hearing {
 public:
  Hearing(const SolveLimits& limits, SolveListener& listener)
      : limits_(limits), listener_(listener), stage_began_(Clock::now()), heard_(stage_began_) {}

  bool hear(Frame&& frame) {
    heard_ = Clock::now();
    switch (messageOf(frame)) {
      case Message::kProgress:
        return hearProgress(frame);
      case Message::kWarning:
        listener_.warn(fieldOf(frame, 0));
        return true;
      case Message::kItem:
        items_.push_back({readItemKind(fieldOf(frame, 0)), fieldOf(frame, 1), ""});
        target_ = nullptr;
        return true;
      case Message::kCheckpoint:
        target_ = &checkpoint_;
        return true;
      case Message::kData:
        (target_ != nullptr ? *target_ : lastItem().bytes) += fieldOf(frame, 0);
        return true;
      case Message::kStageDone:
        return hearStageDone(frame);
      default:
        return hearEnd(frame);
    }
  }

  Clock::time_point deadline() const {
    return std::min(stage_began_ + limits_.stage, heard_ + limits_.silence);
  }

  SolveOutcome conclude(ConversationEnd end, const std::string& status) {
    if (end == ConversationEnd::kStopped) {
      return {SolveOutcome::End::kStopped, {}, {}, {}, {}};
    }
    if (end == ConversationEnd::kComplete) {
      return std::move(outcome_);
    }
    return end == ConversationEnd::kOverdue ? makeOverdue() : makeCrash(status);
  }

 private:
  bool hearProgress(const Frame& frame) {
    const Stage stage = readStage(fieldOf(frame, 0));
    if (stage_ != fieldOf(frame, 0)) {
      stage_ = fieldOf(frame, 0);
      stage_began_ = heard_;
    }
    listener_.progress(stage, unpackDouble(fieldOf(frame, 1)));
    return true;
  }

  bool hearStageDone(const Frame& frame) {
    SolvedStage done{
        readStage(fieldOf(frame, 0)), std::exchange(checkpoint_, {}), std::exchange(items_, {})};
    target_ = nullptr;
    listener_.finish(std::move(done));
    // Storing may have waited for space on the disk, which is not the solver's time.
    stage_began_ = heard_ = Clock::now();
    return true;
  }

  bool hearEnd(const Frame& frame) {
    switch (messageOf(frame)) {
      case Message::kDone:
        hearSuccess(frame);
        return false;
      case Message::kError:
        outcome_ = {SolveOutcome::End::kFailed, {}, {}, {}, readErrorFrame(frame)};
        return false;
      case Message::kOutOfMemory:
        outcome_ = makeDeath(ErrorCode::kJobMemory,
                             "the solver needed more than its " +
                                 std::to_string(limits_.child.memory_mb) + " MiB of memory");
        return false;
      default:
        throw Error(ErrorCode::kJobCrashed, "a child says what only the service says");
    }
  }

  void hearSuccess(const Frame& frame) {
    outcome_.end = SolveOutcome::End::kSucceeded;
    outcome_.items = std::exchange(items_, {});
    outcome_.verdict = fieldOf(frame, 0);
    outcome_.warnings.assign(frame.fields.begin() + 1, frame.fields.end());
  }

  SolvedItem& lastItem() {
    require(!items_.empty(), ErrorCode::kJobCrashed, "a child sends bytes of nothing");
    return items_.back();
  }

  SolveOutcome makeOverdue() const {
    const Clock::time_point now = Clock::now();
    if (now - stage_began_ >= limits_.stage) {
      return makeDeath(ErrorCode::kJobTimeout,
                       "the stage took longer than its " + describe(limits_.stage));
    }
    return makeDeath(ErrorCode::kJobTimeout,
                     "the solver gave no sign of life for " + describe(limits_.silence));
  }

  SolveOutcome makeCrash(const std::string& status) const {
    return makeDeath(ErrorCode::kJobCrashed, "the solver's process ended by " + status);
  }

  SolveOutcome makeDeath(ErrorCode code, const std::string& sentence) const {
    Where where;
    where.stage = stage_;
    return {SolveOutcome::End::kDied, {}, {}, {}, Error(code, sentence, where)};
  }

  static std::string describe(std::chrono::milliseconds span) {
    const auto seconds = static_cast<double>(span.count()) / 1000.0;
    std::string text = std::to_string(seconds);
    return text.substr(0, text.find('.') + 2) + " s";
  }

  const SolveLimits& limits_;
  SolveListener& listener_;
  std::string stage_ = kBeforeStages;
  Clock::time_point stage_began_;
  Clock::time_point heard_;
  std::string checkpoint_;
  std::vector<SolvedItem> items_;
  std::string* target_ = nullptr;  ///< that data belongs to; the last item if null
  SolveOutcome outcome_;
};

}  // namespace

SolveOutcome solveInChild(const ChildCommand& command,
                          const SolveRequest& request,
                          const SolveLimits& limits,
                          SolveListener& listener,
                          const Interrupt* interrupt) {
  ItemSender speech = makeSpeech(request);
  Hearing hearing(limits, listener);
  Child child(command, limits.child);
  Conversation conversation;
  conversation.speak = [&] {
    return speech.next();
  };
  conversation.hear = [&](Frame&& frame) {
    return hearing.hear(std::move(frame));
  };
  conversation.overhear = [&](const std::string& line) {
    listener.print(line);
  };
  conversation.go_on = [&] {
    return listener.goesOn();
  };
  conversation.deadline = [&] {
    return hearing.deadline();
  };
  conversation.tick = limits.tick;
  conversation.interrupt = interrupt;
  const ConversationEnd end = converse(child, conversation);
  return hearing.conclude(end, child.end());
}

}  // namespace gaitmill
