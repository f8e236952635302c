#include "service/config.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"

namespace gaitmill {

namespace {

using nlohmann::json;
using C = ServeConfig;

constexpr double kMost = 1e9;

// The one list of all fields: name, unit, member, lowest, highest, words, meaning.
std::vector<ConfigField> listFields() {
  return {
      {"db", "", &C::db, 0, 0, {}, "Database file, created if absent"},
      {"models",
       "",
       &C::models,
       0,
       0,
       {},
       "Folder of models, marker sets and settings; found beside the program if empty"},
      {"host",
       "",
       &C::host,
       0,
       0,
       {},
       "Address to listen on; without API keys only a loopback address"},
      {"port", "", &C::port, 0, 65535, {}, "Port to listen on; 0 takes a free one and prints it"},
      {"workers", "", &C::workers, 0, 256, {}, "Jobs at a time; 0 = one per hardware thread"},
      {"log_level",
       "",
       &C::log_level,
       0,
       0,
       {"debug", "info", "warn", "error", "off"},
       "What the log on standard error holds"},
      {"log_format", "", &C::log_format, 0, 0, {"text", "json"}, "Form of its lines"},
      {"stop_limit_s",
       "s",
       &C::stop_limit_s,
       0,
       86400,
       {},
       "Running jobs may go on for so long after SIGTERM before they are given back"},
      {"lease_s",
       "s",
       &C::lease_s,
       0.1,
       3600,
       {},
       "A job whose process is silent for so long may be taken by another"},
      {"stage_timeout_s",
       "s",
       &C::stage_timeout_s,
       0.1,
       86400 * 30.0,
       {},
       "Most that one stage of a job may take"},
      {"hang_timeout_s",
       "s",
       &C::hang_timeout_s,
       0.1,
       86400,
       {},
       "A solver that reports nothing for so long is taken for dead"},
      {"park_limit_s",
       "s",
       &C::park_limit_s,
       0,
       86400,
       {},
       "A job whose results find no space on the disk waits for so long"},
      {"job_memory_mb",
       "MiB",
       &C::job_memory_mb,
       0,
       1 << 20,
       {},
       "Address space of one solver; 0 = no limit"},
      {"nice",
       "",
       &C::nice,
       0,
       19,
       {},
       "Added to the niceness of solvers, so that requests come first"},
      {"spool", "", &C::spool, 0, 0, {}, "Folder for uploads under way and archives"},
      {"max_upload_mb", "MiB", &C::max_upload_mb, 1, 1 << 20, {}, "Largest upload"},
      {"max_json_kb", "KiB", &C::max_json_kb, 1, 1 << 20, {}, "Largest JSON body"},
      {"request_threads", "", &C::request_threads, 1, 1024, {}, "Threads that answer requests"},
      {"max_queued_requests",
       "",
       &C::max_queued_requests,
       1,
       1 << 20,
       {},
       "Requests that may wait for a thread; more get 503"},
      {"max_connections", "", &C::max_connections, 8, 1 << 20, {}, "Open connections"},
      {"max_per_address",
       "",
       &C::max_per_address,
       1,
       1 << 20,
       {},
       "Open connections of one address other than loopback"},
      {"max_event_streams", "", &C::max_event_streams, 0, 1 << 20, {}, "Open event streams"},
      {"inspect_in_child_mb",
       "MiB",
       &C::inspect_in_child_mb,
       0,
       1 << 20,
       {},
       "Uploads beyond this are read in a process of their own"},
      {"geometry",
       "",
       &C::geometry,
       0,
       0,
       {},
       "Folder of .vtp, .stl and .obj bones as models name them; stylised ones if empty"},
      {"draw_timeout_s",
       "s",
       &C::draw_timeout_s,
       0.1,
       86400,
       {},
       "Most that one image or validation figure may take"},
      {"draw_idle_s",
       "s",
       &C::draw_idle_s,
       0.1,
       86400,
       {},
       "The process that draws ends after so long without a request"},
      {"draw_memory_mb",
       "MiB",
       &C::draw_memory_mb,
       0,
       1 << 20,
       {},
       "Address space of the process that draws; 0 = no limit"},
      {"max_image_mpx",
       "Mpx",
       &C::max_image_mpx,
       1,
       1000,
       {},
       "Pixels of the largest image, over all its poses or frames, in millions"},
      {"image_cache_mb",
       "MiB",
       &C::image_cache_mb,
       0,
       1 << 20,
       {},
       "Finished images, reports and validation figures kept in memory"},
      {"min_free_mb",
       "MiB",
       &C::min_free_mb,
       0,
       kMost,
       {},
       "Space on the disk that uploads leave free for running jobs"},
      {"max_db_mb",
       "MiB",
       &C::max_db_mb,
       0,
       kMost,
       {},
       "Largest database; 0 = as large as the disk"},
      {"keep_days",
       "d",
       &C::keep_days,
       0,
       36500,
       {},
       "Finished jobs and unused trials are removed after so long; 0 = never"},
      {"quota_mb",
       "MiB",
       &C::quota_mb,
       0,
       kMost,
       {},
       "Uploaded bytes that one API key may have stored; 0 = no limit"},
      {"quota_jobs",
       "",
       &C::quota_jobs,
       0,
       kMost,
       {},
       "Jobs that one API key may have stored; 0 = no limit"},
      {"quota_frames", "", &C::quota_frames, 0, 1e15, {}, "Frames of all its jobs; 0 = no limit"},
      {"quota_pixels",
       "",
       &C::quota_pixels,
       0,
       1e15,
       {},
       "Image pixels of all its jobs; 0 = no limit"},
  };
}

std::string writeNumber(double value) {
  return json(value).dump();
}

[[noreturn]] void refuse(const ConfigField& field, const std::string& text) {
  std::string expected;
  for (const std::string& word : field.words) {
    expected += (expected.empty() ? "one of " : ", ") + word;
  }
  if (expected.empty()) {
    const bool is_whole = std::holds_alternative<int ServeConfig::*>(field.member);
    expected = std::string(is_whole ? "a whole number" : "a number") + " from " +
               writeNumber(field.lowest) + " to " + writeNumber(field.highest) +
               (field.unit.empty() ? "" : " [" + field.unit + "]");
  }
  throw Error(ErrorCode::kConfig,
              "'" + text + "' is no " + field.name + "; expected " + expected,
              {"", 0, 0, field.name});
}

double readNumber(const ConfigField& field, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
  if (!is_number || value < field.lowest || value > field.highest) {
    refuse(field, text);
  }
  return value;
}

const ConfigField& findField(const std::string& name, const std::string& file) {
  std::vector<std::string> names;
  for (const ConfigField& field : configFields()) {
    if (field.name == name) {
      return field;
    }
    names.push_back(field.name);
  }
  const std::string nearest = findNearestName(name, names);
  throw Error(
      ErrorCode::kConfig,
      "unknown field '" + name + "'" + (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
      {file, 0, 0, name});
}

json parseFile(const std::string& text, const std::string& path) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = static_cast<int>(std::count(text.begin(), end, '\n')) + 1;
    throw Error(ErrorCode::kConfig, "this is not JSON", {path, line, 0, ""});
  } catch (const json::out_of_range&) {
    throw Error(ErrorCode::kConfig, "a number is beyond what a double holds", {path, 0, 0, ""});
  }
}

void set(const ConfigField& field,
         const std::string& text,
         ConfigSource source,
         Configuration& configuration) {
  setConfigField(field, text, configuration.values);
  configuration.sources[field.name] = source;
}

}  // namespace

void applyConfigFile(const std::string& text,
                     const std::string& path,
                     Configuration& configuration) {
  const json document = parseFile(text, path);
  require(document.is_object(), ErrorCode::kConfig, "expected a JSON object", {path});
  for (const auto& [name, value] : document.items()) {
    const ConfigField& field = findField(name, path);
    const bool is_text = std::holds_alternative<std::string ServeConfig::*>(field.member);
    require(is_text ? value.is_string() : value.is_number(),
            ErrorCode::kConfig,
            name + (is_text ? " is a text" : " is a number"),
            {path, 0, 0, name});
    try {
      set(field,
          is_text ? value.get<std::string>() : value.dump(),
          ConfigSource::kFile,
          configuration);
    } catch (Error& error) {
      error.setFile(path);
      throw;
    }
  }
}

namespace {

json valueOf(const ConfigField& field, const ServeConfig& config) {
  return std::visit([&](const auto member) { return json(config.*member); }, field.member);
}

const char* nameOf(ConfigSource source) {
  switch (source) {
    case ConfigSource::kDefault:
      return "default";
    case ConfigSource::kFile:
      return "file";
    case ConfigSource::kEnvironment:
      return "environment";
    case ConfigSource::kFlag:
      return "flag";
  }
  return "default";
}

}  // namespace

std::string ConfigField::flag() const {
  std::string text = "--" + name;
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

std::string ConfigField::variable() const {
  std::string text = "GAITMILL_" + name;
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  return text;
}

const std::vector<ConfigField>& configFields() {
  static const std::vector<ConfigField> fields = listFields();
  return fields;
}

void setConfigField(const ConfigField& field, const std::string& text, ServeConfig& config) {
  if (const auto* member = std::get_if<std::string ServeConfig::*>(&field.member)) {
    const bool is_allowed =
        field.words.empty() ||
        std::find(field.words.begin(), field.words.end(), text) != field.words.end();
    if (!is_allowed) {
      refuse(field, text);
    }
    config.*(*member) = text;
    return;
  }
  const double value = readNumber(field, text);
  if (const auto* member = std::get_if<double ServeConfig::*>(&field.member)) {
    config.*(*member) = value;
    return;
  }
  if (value != std::floor(value)) {
    refuse(field, text);
  }
  config.*std::get<int ServeConfig::*>(field.member) = static_cast<int>(value);
}

Configuration loadConfiguration(const std::map<std::string, std::string>& flags,
                                const std::string& file,
                                const Environment& environment) {
  Configuration configuration;
  if (!file.empty()) {
    applyConfigFile(readFile(file), file, configuration);
  }
  for (const ConfigField& field : configFields()) {
    if (const auto value = environment(field.variable())) {
      try {
        set(field, *value, ConfigSource::kEnvironment, configuration);
      } catch (Error& error) {
        error.addContext("reading " + field.variable());
        throw;
      }
    }
  }
  for (const auto& [name, value] : flags) {
    set(findField(name, ""), value, ConfigSource::kFlag, configuration);
  }
  return configuration;
}

std::string printConfiguration(const Configuration& configuration) {
  json document = json::object();
  for (const ConfigField& field : configFields()) {
    const auto source = configuration.sources.find(field.name);
    json& entry = document[field.name];
    entry["value"] = valueOf(field, configuration.values);
    entry["default"] = valueOf(field, ServeConfig{});
    entry["source"] =
        nameOf(source == configuration.sources.end() ? ConfigSource::kDefault : source->second);
    if (!field.unit.empty()) {
      entry["unit"] = field.unit;
    }
    entry["help"] = field.help;
  }
  return document.dump(2);
}

bool isLoopback(const std::string& host) {
  // A number, not a beginning: "127.example.org" is a name like any other.
  in_addr address{};
  const bool is_number = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
  return host == "localhost" || host == "::1" || host == "[::1]" ||
         (is_number && (ntohl(address.s_addr) >> 24U) == 127);
}

}  // namespace gaitmill
