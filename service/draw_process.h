#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/error.h"
#include "service/process/child.h"
#include "service/process/conversation.h"

namespace gaitmill {

struct DrawLimits {
  std::chrono::milliseconds deadline{120'000};  ///< of one request, from its turn on
  std::chrono::milliseconds idle{300'000};      ///< without requests after which the child ends
  std::size_t waiting = 8;                      ///< requests that may wait for their turn
  ChildLimits child;
};

struct DrawRequest {
  std::string task;      ///< as by encodeDrawTask()
  std::string data_key;  ///< equal for equal data: the child keeps the last one
  /// Byte strings by name, as by encodeDrawData(). Asked only if the child has not got them.
  std::function<std::map<std::string, std::string>()> read_data;
};

struct DrawReply {
  std::string content_type;
  std::string bytes;
};

/// A child process that draws, because a graphics library may crash, and a model that somebody has
/// uploaded may take any time and memory: the service lives on, and the memory goes back. The child
/// is started by the first request, keeps what the last one took to prepare, ends when nobody
/// asks for a while, and is replaced when it dies. One request at a time. Safe from any thread.
class DrawProcess {
 public:
  DrawProcess(ChildCommand command, DrawLimits limits);
  ~DrawProcess();
  DrawProcess(const DrawProcess&) = delete;
  DrawProcess& operator=(const DrawProcess&) = delete;

  /// Waits for its turn and for the answer. A child that dies meanwhile gets a successor, once.
  /// @throws Error of the child; kRequestBusy if too many wait or the service stops; kRender if the
  ///         child dies twice, needs more than its memory or its time; what read_data throws
  DrawReply ask(const DrawRequest& request);
  /// Ends the child; requests get kRequestBusy from now on.
  void stop();
  /// Of the child that runs, or -1.
  pid_t findPid() const;

 private:
  struct Order {
    const DrawRequest* request;
    std::promise<DrawReply> reply;
  };

  void work();
  std::shared_ptr<Order> takeOrder();
  DrawReply draw(const DrawRequest& request);
  bool converseOnce(const DrawRequest& request, DrawReply& reply);
  void startChild();
  void endChild();

  const ChildCommand command_;
  const DrawLimits limits_;
  Interrupt interrupt_;
  mutable std::mutex guard_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Order>> orders_;
  bool stopping_ = false;
  pid_t pid_ = -1;

  // Of the thread alone: a child dies with the thread that started it.
  std::unique_ptr<Child> child_;
  bool is_sound_ = true;  ///< whether the child can be asked again
  std::string data_key_;  ///< of what the child has
  std::thread thread_;
};

}  // namespace gaitmill
