#pragma once

#include <chrono>
#include <string>

namespace gaitmill {

/// How `gaitmill serve` runs. Each field has a flag and an environment variable of the same name
/// (--db, GAITMILL_DB); the flag wins.
struct ServeConfig {
  std::string database = "gaitmill.db";          ///< --db
  std::string host = "127.0.0.1";                ///< --host
  int port = 8080;                               ///< --port, 0 = any free one
  int workers = 0;                               ///< --workers, 0 = one per hardware thread
  std::string models = "models";                 ///< --models
  std::string log_level = "info";                ///< --log-level
  std::chrono::milliseconds stop_limit{10'000};  ///< for running jobs to stop after SIGTERM
};

}  // namespace gaitmill
