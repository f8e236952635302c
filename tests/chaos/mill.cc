#include "tests/chaos/mill.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <sqlite3.h>

extern char** environ;

namespace gaitmill {

namespace {

std::string readLine(int fd) {
  std::string line;
  char letter = 0;
  while (::read(fd, &letter, 1) == 1 && letter != '\n') {
    line += letter;
  }
  return line;
}

// Its parent, as the fourth word behind the name in parentheses.
pid_t findParent(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string stat = text.str();
  const std::size_t end = stat.rfind(')');
  if (end == std::string::npos) {
    return -1;
  }
  std::istringstream rest(stat.substr(end + 1));
  std::string state;
  pid_t parent = -1;
  rest >> state >> parent;
  return state == "Z" ? -1 : parent;
}

}  // namespace

Mill::Mill(const std::string& program,
           const std::string& database,
           const std::string& models,
           int workers) {
  std::vector<std::string> texts = {program,
                                    "serve",
                                    "--db",
                                    database,
                                    "--port",
                                    "0",
                                    "--workers",
                                    std::to_string(workers),
                                    "--models",
                                    models,
                                    "--log-level",
                                    "error"};
  std::vector<char*> arguments;
  for (std::string& text : texts) {
    arguments.push_back(text.data());
  }
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int failed =
      ::posix_spawn(&pid_, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  output_ = ends[0];
  const std::string line = failed == 0 ? readLine(output_) : "";
  if (line.empty()) {
    ::close(output_);
    throw std::runtime_error("the service did not start");
  }
  client_ = HttpClient(std::stoi(line.substr(line.rfind(':') + 1)));
}

Mill::~Mill() {
  killGroup();
  ::close(output_);
}

void Mill::killGroup() {
  if (pid_ > 0) {
    ::kill(-pid_, SIGKILL);
    reap();
  }
}

void Mill::killService() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    reap();
  }
}

void Mill::reap() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
}

std::vector<pid_t> Mill::listSolvers() const {
  std::vector<pid_t> solvers;
  DIR* folder = ::opendir("/proc");
  while (const dirent* entry = ::readdir(folder)) {
    const std::string name = entry->d_name;
    if (name.find_first_not_of("0123456789") == std::string::npos && findParent(name) == pid_) {
      solvers.push_back(std::stoi(name));
    }
  }
  ::closedir(folder);
  return solvers;
}

bool isRunning(pid_t pid) {
  return findParent(std::to_string(pid)) >= 0;
}

std::string checkIntegrity(const std::string& database) {
  sqlite3* db = nullptr;
  std::string verdict = "cannot be opened";
  if (sqlite3_open(database.c_str(), &db) == SQLITE_OK) {
    sqlite3_busy_timeout(db, 5000);
    const auto take = [](void* text, int, char** values, char**) {
      *static_cast<std::string*>(text) = values[0];
      return 0;
    };
    char* error = nullptr;
    sqlite3_exec(db, "PRAGMA integrity_check", take, &verdict, &error);
    verdict = error == nullptr ? verdict : error;
    sqlite3_free(error);
  }
  sqlite3_close(db);
  return verdict;
}

}  // namespace gaitmill
