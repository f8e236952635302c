#include "service/draw_process.h"

#include <exception>
#include <optional>
#include <utility>

#include "service/observe/log.h"
#include "service/process/item_sender.h"
#include "service/process/messages.h"

namespace gaitmill {

namespace {

using Clock = Conversation::Clock;
using Parts = std::map<std::string, std::string>;

constexpr std::size_t kMaxReply = 256U << 20U;  // [bytes]; an image has at most 10 MB

Error makeBusy(const std::string& reason) {
  return {ErrorCode::kRequestBusy, reason, {"", 0, 0, "service"}};
}

// @param parts  outlives what is made; empty if the child has them
ItemSender makeSpeech(const DrawRequest& request, const Parts& parts) {
  ItemSender speech;
  speech.add(makeFrame(Message::kTask, {request.task}));
  for (const auto& [name, bytes] : parts) {
    speech.add(makeFrame(Message::kPart, {name, ""}), bytes.size(), readFromMemory(bytes));
  }
  speech.add(makeFrame(Message::kGo));
  return speech;
}

struct Answer {
  DrawReply reply;
  std::optional<Error> error;
};

bool hear(Frame&& frame, Answer& answer) {
  switch (messageOf(frame)) {
    case Message::kItem:
      answer.reply = {fieldOf(frame, 0), ""};
      return true;
    case Message::kData:
      answer.reply.bytes += fieldOf(frame, 0);
      require(answer.reply.bytes.size() <= kMaxReply,
              ErrorCode::kJobCrashed,
              "a child sends more than an image can have");
      return true;
    case Message::kDone:
      return false;
    case Message::kError:
      answer.error = readErrorFrame(frame);
      return false;
    case Message::kOutOfMemory:
      answer.error = Error(ErrorCode::kRender, "drawing this takes more memory than there is");
      return false;
    default:
      throw Error(ErrorCode::kJobCrashed, "the child that draws says what only a solver says");
  }
}

}  // namespace

DrawProcess::DrawProcess(ChildCommand command, DrawLimits limits)
    : command_(std::move(command)), limits_(limits), thread_([this] { work(); }) {}

DrawProcess::~DrawProcess() {
  stop();
  thread_.join();
}

void DrawProcess::stop() {
  const std::lock_guard<std::mutex> lock(guard_);
  stopping_ = true;
  interrupt_.raise();
  changed_.notify_all();
}

pid_t DrawProcess::findPid() const {
  const std::lock_guard<std::mutex> lock(guard_);
  return pid_;
}

DrawReply DrawProcess::ask(const DrawRequest& request) {
  const auto order = std::make_shared<Order>();
  order->request = &request;
  std::future<DrawReply> reply = order->reply.get_future();
  {
    const std::lock_guard<std::mutex> lock(guard_);
    if (stopping_) {
      throw makeBusy("the service is stopping");
    }
    if (orders_.size() >= limits_.waiting) {
      throw makeBusy("more images are waiting to be drawn than can be drawn soon");
    }
    orders_.push_back(order);
  }
  changed_.notify_all();
  return reply.get();
}

// Every order that was taken in is answered, whatever happens.
void DrawProcess::work() {
  while (const std::shared_ptr<Order> order = takeOrder()) {
    try {
      order->reply.set_value(draw(*order->request));
    } catch (...) {
      order->reply.set_exception(std::current_exception());
    }
    if (!is_sound_) {
      endChild();
    }
  }
  endChild();
  const std::lock_guard<std::mutex> lock(guard_);
  for (const std::shared_ptr<Order>& order : orders_) {
    order->reply.set_exception(std::make_exception_ptr(makeBusy("the service is stopping")));
  }
  orders_.clear();
}

// Waits for an order; meanwhile a child that nobody has asked for a while is ended.
std::shared_ptr<DrawProcess::Order> DrawProcess::takeOrder() {
  std::unique_lock<std::mutex> lock(guard_);
  const auto is_due = [this] {
    return stopping_ || !orders_.empty();
  };
  if (!changed_.wait_for(lock, limits_.idle, is_due)) {
    lock.unlock();
    endChild();
    lock.lock();
    changed_.wait(lock, is_due);
  }
  if (stopping_) {
    return nullptr;
  }
  std::shared_ptr<Order> order = std::move(orders_.front());
  orders_.pop_front();
  return order;
}

DrawReply DrawProcess::draw(const DrawRequest& request) {
  DrawReply reply;
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (converseOnce(request, reply)) {
      return reply;
    }
  }
  throw Error(ErrorCode::kRender, "the process that draws has died over this, twice");
}

// @returns false if the child has died
bool DrawProcess::converseOnce(const DrawRequest& request, DrawReply& reply) {
  startChild();
  const Parts parts = request.data_key == data_key_ ? Parts{} : request.read_data();
  is_sound_ = false;
  ItemSender speech = makeSpeech(request, parts);
  Answer answer;
  const Clock::time_point deadline = Clock::now() + limits_.deadline;
  Conversation conversation;
  conversation.speak = [&] {
    return speech.next();
  };
  conversation.hear = [&](Frame&& frame) {
    return hear(std::move(frame), answer);
  };
  conversation.overhear = [](const std::string& line) {
    logEvent(Severity::kInfo, "draw.says", {{"message", line}});
  };
  conversation.go_on = [this] {
    const std::lock_guard<std::mutex> lock(guard_);
    return !stopping_;
  };
  conversation.deadline = [&] {
    return deadline;
  };
  conversation.interrupt = &interrupt_;
  const ConversationEnd end = converse(*child_, conversation);
  if (end == ConversationEnd::kClosed) {
    endChild();
    return false;
  }
  if (end == ConversationEnd::kStopped) {
    throw makeBusy("the service is stopping");
  }
  require(end == ConversationEnd::kComplete, ErrorCode::kRender, "drawing this takes too long");
  // After a fault of the library a new child is the safer one.
  is_sound_ = !answer.error || answer.error->code() != ErrorCode::kRender;
  data_key_ = request.data_key;
  if (answer.error) {
    throw Error(*answer.error);
  }
  reply = std::move(answer.reply);
  return true;
}

void DrawProcess::startChild() {
  if (child_ != nullptr) {
    return;
  }
  child_ = std::make_unique<Child>(command_, limits_.child);
  is_sound_ = true;
  logEvent(Severity::kDebug, "draw.started", {{"pid", child_->pid()}});
  const std::lock_guard<std::mutex> lock(guard_);
  pid_ = child_->pid();
}

void DrawProcess::endChild() {
  data_key_.clear();
  if (child_ == nullptr) {
    return;
  }
  const std::string status = child_->end();
  child_.reset();
  logEvent(Severity::kInfo, "draw.ended", {{"message", status}});
  const std::lock_guard<std::mutex> lock(guard_);
  pid_ = -1;
}

}  // namespace gaitmill
