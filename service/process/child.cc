#include "service/process/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <new>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr rlim_t kMaxFiles = 64;

struct ChannelPair {
  OwnedFd ours;
  OwnedFd theirs;
};

void requireSystem(bool ok, const char* step) {
  if (!ok) {
    throw Error(ErrorCode::kInternal, std::string(step) + ": " + ::strerrordesc_np(errno));
  }
}

void setNonBlocking(int fd) {
  ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
}

ChannelPair makeChannel() {
  std::array<int, 2> ends{};
  requireSystem(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0,
                "opening a channel to a child");
  setNonBlocking(ends[0]);
  return {OwnedFd(ends[0]), OwnedFd(ends[1])};
}

ChannelPair makeErrorPipe() {
  std::array<int, 2> ends{};
  requireSystem(::pipe2(ends.data(), O_CLOEXEC) == 0, "opening a pipe from a child");
  setNonBlocking(ends[0]);
  return {OwnedFd(ends[0]), OwnedFd(ends[1])};
}

std::vector<std::string> makeEnvironment() {
  // The renderer would keep compiled shaders in files, which a child may not write, and would take
  // every core, which the solvers need.
  std::vector<std::string> kept = {
      "LC_ALL=C.UTF-8", "MESA_SHADER_CACHE_DISABLE=true", "LP_NUM_THREADS=1"};
  for (const char* name : {"PATH",
                           "GALLIUM_DRIVER",
                           "LD_LIBRARY_PATH",
                           "ASAN_OPTIONS",
                           "UBSAN_OPTIONS",
                           "TSAN_OPTIONS",
                           "LSAN_OPTIONS"}) {
    if (const char* value = std::getenv(name)) {
      kept.push_back(std::string(name) + "=" + value);
    }
  }
  return kept;
}

std::vector<char*> makePointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

// The files of the child, and signals as a new program expects them: the service blocks those that
// stop it, and ignores SIGPIPE.
class SpawnPlan {
 public:
  SpawnPlan(int channel, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, channel, Child::kChannelFd);
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, Child::kChannelFd + 1);
    ::posix_spawnattr_init(&attributes_);
    sigset_t none{};
    sigset_t all{};
    sigemptyset(&none);
    sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  pid_t spawn(std::vector<std::string> arguments) const {
    std::vector<std::string> environment = makeEnvironment();
    pid_t pid = -1;
    errno = ::posix_spawn(&pid,
                          arguments.front().c_str(),
                          &actions_,
                          &attributes_,
                          makePointers(arguments).data(),
                          makePointers(environment).data());
    requireSystem(errno == 0, "starting a child process");
    return pid;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

std::string describeStatus(int status) {
  if (WIFSIGNALED(status)) {
    const char* name = ::sigabbrev_np(WTERMSIG(status));
    return "signal " +
           (name == nullptr ? std::to_string(WTERMSIG(status)) : "SIG" + std::string(name));
  }
  return "exit code " + std::to_string(WEXITSTATUS(status));
}

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  now.rlim_max = now.rlim_max < most ? now.rlim_max : most;
  now.rlim_cur = now.rlim_max;
  ::setrlimit(resource, &now);
}

// Sanitizers map terabytes of shadow memory that they never touch.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMayLimitMemory = false;
#else
constexpr bool kMayLimitMemory = true;
#endif

// What the handler of used-up memory sends; it must not allocate.
std::string& farewellBytes() {
  static std::string bytes;
  return bytes;
}

void sayFarewell() {
  const std::string& bytes = farewellBytes();
  ssize_t ignored = ::send(Child::kChannelFd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  static_cast<void>(ignored);
  std::_Exit(EXIT_FAILURE);
}

// When the machine itself runs out of memory, the kernel should take a solver, not the service.
void volunteerForOutOfMemory() {
  const OwnedFd file(::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC));
  ssize_t ignored = ::write(file.get(), "500", 3);
  static_cast<void>(ignored);
}

}  // namespace

OwnedFd& OwnedFd::operator=(OwnedFd&& other) noexcept {
  if (this != &other) {
    reset();
    fd_ = other.release();
  }
  return *this;
}

int OwnedFd::release() {
  return std::exchange(fd_, -1);
}

void OwnedFd::reset() {
  if (fd_ >= 0) {
    ::close(fd_);
    fd_ = -1;
  }
}

Child::Child(const ChildCommand& command, const ChildLimits& limits) {
  ChannelPair channel = makeChannel();
  ChannelPair errors = makeErrorPipe();
  std::vector<std::string> arguments = command;
  for (const std::string& argument : {std::string("--parent"),
                                      std::to_string(::getpid()),
                                      std::string("--memory-mb"),
                                      std::to_string(limits.memory_mb),
                                      std::string("--nice"),
                                      std::to_string(limits.nice)}) {
    arguments.push_back(argument);
  }
  pid_ = SpawnPlan(channel.theirs.get(), errors.theirs.get()).spawn(std::move(arguments));
  channel_ = std::move(channel.ours);
  errors_ = std::move(errors.ours);
}

Child::~Child() {
  end();
}

// The status of a child that has died by itself stays what it is: a later SIGKILL does not count.
std::string Child::end() {
  if (pid_ < 0) {
    return "";
  }
  int status = 0;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return describeStatus(status);
}

void becomeChild(pid_t parent, const ChildLimits& limits, const std::string& farewell) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    std::_Exit(EXIT_FAILURE);  // it died before we could ask to be told
  }
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    std::signal(number, SIG_IGN);
  }
  volunteerForOutOfMemory();
  ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + limits.nice);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, kMaxFiles);
  if (kMayLimitMemory && limits.memory_mb > 0) {
    limit(RLIMIT_AS, static_cast<rlim_t>(limits.memory_mb) << 20U);
  }
  farewellBytes() = farewell;
  std::set_new_handler(sayFarewell);
}

}  // namespace gaitmill
