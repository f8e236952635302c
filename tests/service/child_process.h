#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace gaitmill {

/// A process of its own whose standard output is read line by line. Killed when it goes.
class ChildProcess {
 public:
  /// @param command  path of the program and its arguments
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Empty at the end of output.
  std::string readLine();
  void signal(int number) const;
  pid_t pid() const { return pid_; }
  /// Waits for the end. @returns the exit code, or 128 + the signal that ended it
  int wait();

 private:
  pid_t pid_ = -1;
  int output_ = -1;
};

}  // namespace gaitmill
