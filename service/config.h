#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gaitmill {

/// How `gaitmill serve` and `gaitmill work` run. What each field means, its range and its unit
/// stand in configFields(), once for flags, environment, file and documentation.
struct ServeConfig {
  std::string db = "gaitmill.db";
  std::string models;
  std::string host = "127.0.0.1";
  int port = 8080;
  int workers = 0;

  std::string log_level = "info";
  std::string log_format = "text";

  double stop_limit_s = 10;
  double lease_s = 10;
  double stage_timeout_s = 900;
  double hang_timeout_s = 120;
  double park_limit_s = 900;
  int job_memory_mb = 2048;
  int nice = 10;

  std::string spool = "/var/tmp";
  int max_upload_mb = 256;
  int max_json_kb = 1024;
  int request_threads = 16;
  int max_queued_requests = 512;
  int max_connections = 4096;
  int max_per_address = 256;
  int max_event_streams = 256;
  int inspect_in_child_mb = 8;

  std::string geometry;
  double draw_timeout_s = 120;
  double draw_idle_s = 300;
  int draw_memory_mb = 2048;
  int max_image_mpx = 250;
  int image_cache_mb = 64;

  int min_free_mb = 64;
  int max_db_mb = 0;
  int keep_days = 0;
  double quota_mb = 0;
  double quota_jobs = 0;
  double quota_frames = 0;
  double quota_pixels = 0;
};

/// One field of the configuration: the flag --job-memory-mb, the variable GAITMILL_JOB_MEMORY_MB
/// and the member "job_memory_mb" of a configuration file.
struct ConfigField {
  using Member =
      std::variant<std::string ServeConfig::*, int ServeConfig::*, double ServeConfig::*>;
  std::string name;
  std::string unit;  ///< "" if it has none
  Member member;
  double lowest = 0;  ///< of numbers
  double highest = std::numeric_limits<double>::max();
  std::vector<std::string> words;  ///< of a text; empty = any
  std::string help;

  std::string flag() const;
  std::string variable() const;
};

const std::vector<ConfigField>& configFields();

/// Where a value comes from, in rising priority.
enum class ConfigSource { kDefault, kFile, kEnvironment, kFlag };

/// The value of an environment variable, nothing if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

struct Configuration {
  ServeConfig values;
  std::map<std::string, ConfigSource> sources;  ///< of the fields that are not at their default
};

/// Puts defaults, file, environment and flags over each other.
/// @param flags  by field name
/// @param file   path of a JSON object; empty = none
/// @throws Error kConfig naming file or variable and the field, with the nearest name for an
///         unknown one; kFileNotFound
Configuration loadConfiguration(const std::map<std::string, std::string>& flags,
                                const std::string& file,
                                const Environment& environment);

/// Sets what the text of a configuration file says. @throws Error kConfig as loadConfiguration
void applyConfigFile(const std::string& text,
                     const std::string& path,
                     Configuration& configuration);

/// Sets one field from text. @throws Error kConfig naming what is allowed
void setConfigField(const ConfigField& field, const std::string& text, ServeConfig& config);

/// {"port": {"value": 8080, "source": "default", "unit": "", "help": …}, …}
std::string printConfiguration(const Configuration& configuration);

/// Whether only this machine can reach an address.
bool isLoopback(const std::string& host);

}  // namespace gaitmill
