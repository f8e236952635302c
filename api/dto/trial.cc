#include "api/dto/trial.h"

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

// Bounds that a living person fits and a mistaken unit (pounds, centimetres) mostly does not.
constexpr NumberRange kMassRange{5.0, 300.0, "kg"};
constexpr NumberRange kHeightRange{0.4, 2.6, "m"};

template <class T>
void putIfPresent(json& object, const char* key, const std::optional<T>& value) {
  if (value) {
    object[key] = *value;
  }
}

template <class T>
std::optional<T> getIfPresent(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional<T>(found->get<T>());
}

json toJson(const UnderstoodFile& file) {
  json object{{"part", file.part},
              {"name", file.name},
              {"size_bytes", file.size},
              {"sha256", file.sha256},
              {"format", file.format}};
  putIfPresent(object, "frames", file.frames);
  putIfPresent(object, "rate_hz", file.rate);
  putIfPresent(object, "start_s", file.start);
  putIfPresent(object, "end_s", file.end);
  if (!file.labels_kind.empty()) {
    object[file.labels_kind] = file.labels;
  }
  return object;
}

UnderstoodFile fromJson(const json& object) {
  UnderstoodFile file;
  file.part = object.at("part");
  file.name = object.at("name");
  file.size = object.at("size_bytes");
  file.sha256 = object.at("sha256");
  file.format = object.at("format");
  file.frames = getIfPresent<int>(object, "frames");
  file.rate = getIfPresent<double>(object, "rate_hz");
  file.start = getIfPresent<double>(object, "start_s");
  file.end = getIfPresent<double>(object, "end_s");
  for (const char* kind : {"markers", "forces", "columns", "muscles"}) {
    if (object.contains(kind)) {
      file.labels_kind = kind;
      file.labels = object.at(kind).get<std::vector<std::string>>();
    }
  }
  return file;
}

json toJson(const std::vector<UnderstoodFile>& files) {
  json list = json::array();
  for (const UnderstoodFile& file : files) {
    list.push_back(toJson(file));
  }
  return list;
}

}  // namespace

const std::vector<std::string>& trialParts() {
  static const std::vector<std::string> parts = {
      "markers", "grf", "static", "static2", "emg", "model", "coordinates"};
  return parts;
}

TrialSubject parseTrialSubject(const std::string& text) {
  const json object = parseJson(text, "trial");
  ObjectReader reader(object, "trial");
  TrialSubject subject;
  subject.mass = reader.number("mass_kg", kMassRange);
  subject.height = reader.number("height_m", kHeightRange);
  subject.marker_set = reader.optionalText("marker_set");
  if (const json* options = reader.value("options")) {
    require(options->is_object(),
            ErrorCode::kRequestField,
            "field 'options' must be a JSON object of settings",
            {"", 0, 0, "trial.options"});
    subject.options = dumpJson(*options);
  }
  reader.finish();
  return subject;
}

std::string renderTrial(const TrialView& trial) {
  json object{{"id", trial.id},
              {"created_at", formatTimestamp(trial.created_at)},
              {"mass_kg", trial.subject.mass},
              {"height_m", trial.subject.height},
              {"marker_set", nullptr},
              {"options", json::parse(trial.subject.options)},
              {"files", toJson(trial.files)},
              {"warnings", trial.warnings}};
  if (trial.subject.marker_set) {
    object["marker_set"] = *trial.subject.marker_set;
  }
  return dumpJson(object);
}

std::string encodeUnderstoodFiles(const std::vector<UnderstoodFile>& files) {
  return dumpJson(toJson(files));
}

std::vector<UnderstoodFile> decodeUnderstoodFiles(const std::string& text) {
  std::vector<UnderstoodFile> files;
  for (const json& object : json::parse(text)) {
    files.push_back(fromJson(object));
  }
  return files;
}

}  // namespace gaitmill::api
