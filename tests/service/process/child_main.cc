// process_child --parent PID --memory-mb N --nice N: a solver that does what the settings' name
// says.

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "service/process/child.h"
#include "service/process/child_channel.h"
#include "service/process/messages.h"

namespace gaitmill {
namespace {

// Everything the service says, item by item.
struct Assignment {
  std::string task;
  std::map<std::string, std::string> items;
  std::vector<std::string> checkpoints;
};

Assignment receive(ChildChannel& channel) {
  Assignment assignment;
  std::string* target = nullptr;
  for (Frame frame = channel.receive(); messageOf(frame) != Message::kGo;
       frame = channel.receive()) {
    switch (messageOf(frame)) {
      case Message::kSettings:
        assignment.task = fieldOf(frame, 0);
        target = &assignment.items["settings"];
        break;
      case Message::kPart:
        target = &assignment.items[fieldOf(frame, 0)];
        break;
      case Message::kCheckpoint:
        target = &assignment.checkpoints.emplace_back();
        break;
      case Message::kData:
        *target += fieldOf(frame, 0);
        break;
      default:
        break;
    }
  }
  return assignment;
}

void sleepForever() {
  while (true) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

void eatMemory() {
  std::vector<std::vector<char>> eaten;
  while (true) {
    eaten.emplace_back(8U << 20U, 'x');
  }
}

// What a child can see of the service: open files and its environment.
std::string describeSurroundings() {
  std::string text;
  for (int fd = 0; fd < 1000; ++fd) {
    if (::fcntl(fd, F_GETFD) >= 0) {
      text += std::to_string(fd) + " ";
    }
  }
  return text + (std::getenv("GAITMILL_SECRET") == nullptr ? "clean" : "leaking");
}

void echo(ChildChannel& channel, const Assignment& assignment) {
  channel.send(makeFrame(Message::kProgress, {"ik", packDouble(0.5)}));
  channel.send(makeFrame(Message::kWarning, {"a sentence"}));
  for (const auto& [name, bytes] : assignment.items) {
    channel.sendItem(makeFrame(Message::kItem, {"f", name}), bytes);
  }
  channel.sendItem(makeFrame(Message::kCheckpoint), "left by ik");
  channel.send(makeFrame(Message::kStageDone, {"ik"}));
  for (const std::string& checkpoint : assignment.checkpoints) {
    channel.sendItem(makeFrame(Message::kItem, {"t", "checkpoint"}), checkpoint);
  }
  channel.sendItem(makeFrame(Message::kItem, {"s", "surroundings"}), describeSurroundings());
  std::cerr << "a line\n\x1b[31mred\n" << std::flush;
  channel.send(makeFrame(Message::kDone, {"warn", "a sentence"}));
}

void fail(ChildChannel& channel) {
  Where where{"walk.trc", 7, 3, "RASI", "ik", 0.25, "RASI", "soleus_r", "knee_angle_r"};
  Error error(ErrorCode::kInputMarkers, "markers are missing", where);
  error.addContext("ik");
  error.addContext("trial");
  channel.send(makeErrorFrame(error));
}

void speakForever(ChildChannel& channel) {
  channel.send(makeFrame(Message::kProgress, {"rra", packDouble(0.1)}));
  while (true) {
    channel.send(makeFrame(Message::kProgress, {"rra", packDouble(0.2)}));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void sendGarbage() {
  const std::string garbage(100, '\xff');
  ::send(Child::kChannelFd, garbage.data(), garbage.size(), 0);
  sleepForever();
}

void perform(ChildChannel& channel, const Assignment& assignment) {
  const std::string& task = assignment.task;
  if (task == "echo") {
    echo(channel, assignment);
  } else if (task == "fail") {
    fail(channel);
  } else if (task == "abort") {
    channel.send(makeFrame(Message::kProgress, {"so", packDouble(0.1)}));
    std::abort();
  } else if (task == "segfault") {
    std::signal(SIGSEGV, SIG_DFL);  // sanitizers put a handler of their own there
    std::raise(SIGSEGV);
  } else if (task == "exit") {
    std::_Exit(3);
  } else if (task == "hang") {
    sleepForever();
  } else if (task == "speak") {
    speakForever(channel);
  } else if (task == "eat") {
    eatMemory();
  } else if (task == "garbage") {
    sendGarbage();
  }
}

}  // namespace
}  // namespace gaitmill

int main(int argc, char** argv) {
  using namespace gaitmill;
  if (argc < 7) {
    return EXIT_FAILURE;
  }
  const ChildLimits limits{std::atoi(argv[4]), std::atoi(argv[6])};
  becomeChild(std::atoi(argv[2]), limits, encodeFrame(makeFrame(Message::kOutOfMemory)));
  ChildChannel channel(Child::kChannelFd);
  perform(channel, receive(channel));
  return EXIT_SUCCESS;
}
