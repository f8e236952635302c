#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "tests/http/http_client.h"

namespace gaitmill {

/// One life of `gaitmill serve` in a process group of its own.
class Mill {
 public:
  /// Starts it and waits until it says its address. @throws std::runtime_error if it does not
  /// @param models  folder
  Mill(const std::string& program,
       const std::string& database,
       const std::string& models,
       int workers);
  /// Kills the whole group.
  ~Mill();
  Mill(const Mill&) = delete;
  Mill& operator=(const Mill&) = delete;

  const HttpClient& client() const { return client_; }
  /// SIGKILL to the service and all its solvers.
  void killGroup();
  /// SIGKILL to the service alone.
  void killService();
  /// Processes that the service has started and that still run.
  std::vector<pid_t> listSolvers() const;

 private:
  void reap();

  pid_t pid_ = -1;
  int output_ = -1;
  HttpClient client_{0};
};

/// Whether a process still runs; one that nobody has reaped does not.
bool isRunning(pid_t pid);

/// "ok", or what PRAGMA integrity_check finds.
std::string checkIntegrity(const std::string& database);

}  // namespace gaitmill
