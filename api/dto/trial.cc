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

json textOrNull(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

json toJson(const MarkerSetMatch& match) {
  return {{"marker_set", match.marker_set}, {"found", match.found}, {"missing", match.missing}};
}

MarkerSetMatch toMarkerSetMatch(const json& object) {
  return {object.at("marker_set"),
          object.at("found").get<std::vector<std::string>>(),
          object.at("missing").get<std::vector<std::string>>()};
}

json toJson(const ContactView& contact) {
  return {{"plate", contact.plate},
          {"foot", textOrNull(contact.foot)},
          {"start_s", contact.strike},
          {"end_s", contact.toe_off},
          {"starts_with_foot_strike", contact.has_strike},
          {"ends_with_toe_off", contact.has_toe_off},
          {"confidence", contact.confidence},
          {"reason", contact.reason},
          {"flags", contact.flags}};
}

ContactView toContact(const json& object) {
  ContactView contact;
  contact.plate = object.at("plate");
  contact.foot = object.at("foot").is_null() ? "" : object.at("foot").get<std::string>();
  contact.strike = object.at("start_s");
  contact.toe_off = object.at("end_s");
  contact.has_strike = object.at("starts_with_foot_strike");
  contact.has_toe_off = object.at("ends_with_toe_off");
  // Trials stored by earlier versions do not have these.
  contact.confidence = object.value("confidence", 0.0);
  contact.reason = object.value("reason", "");
  contact.flags = object.value("flags", std::vector<std::string>{});
  return contact;
}

json toJson(const EmgChannelView& channel) {
  return {{"channel", channel.channel}, {"side", channel.side}, {"muscles", channel.muscles}};
}

EmgView toEmg(const json& object) {
  EmgView emg;
  emg.source = object.at("source");
  for (const json& channel : object.at("channels")) {
    emg.channels.push_back({channel.at("channel"),
                            channel.at("side"),
                            channel.at("muscles").get<std::vector<std::string>>()});
  }
  emg.force_channels = object.at("force_channels").get<std::vector<std::string>>();
  return emg;
}

json toJson(const PlateView& plate) {
  return {{"name", plate.name}, {"type", plate.type}, {"refusal", textOrNull(plate.refusal)}};
}

json toJson(const MarkedEventView& event) {
  return {{"label", event.label}, {"context", event.context}, {"time_s", event.time}};
}

json toJson(const MarkerFaultView& fault) {
  return {{"fault", fault.fault},
          {"action", fault.action},
          {"marker", fault.marker},
          {"other", textOrNull(fault.other)},
          {"start_s", fault.start},
          {"end_s", fault.end},
          {"frames", fault.frames},
          {"size_m", fault.size ? json(*fault.size) : json(nullptr)}};
}

std::string textOrEmpty(const json& value) {
  return value.is_null() ? "" : value.get<std::string>();
}

RecordingView toRecording(const json& object) {
  RecordingView recording;
  for (const json& plate : object.at("plates")) {
    recording.plates.push_back(
        {plate.at("name"), plate.at("type"), textOrEmpty(plate.at("refusal"))});
  }
  recording.analog_channels = object.at("analog_channels").get<std::vector<std::string>>();
  recording.analog_rate = object.at("analog_rate_hz");
  for (const json& event : object.at("events")) {
    recording.events.push_back({event.at("label"), event.at("context"), event.at("time_s")});
  }
  return recording;
}

MarkerFaultView toMarkerFault(const json& object) {
  MarkerFaultView fault;
  fault.fault = object.at("fault");
  fault.action = object.at("action");
  fault.marker = object.at("marker");
  fault.other = textOrEmpty(object.at("other"));
  fault.start = object.at("start_s");
  fault.end = object.at("end_s");
  fault.frames = object.at("frames");
  if (!object.at("size_m").is_null()) {
    fault.size = object.at("size_m").get<double>();
  }
  return fault;
}

json toJson(const GaitEventView& event) {
  return {{"event", event.kind},
          {"foot", event.foot},
          {"time_s", event.time},
          {"source", event.source},
          {"marker_difference_s",
           event.marker_difference ? json(*event.marker_difference) : json(nullptr)}};
}

GaitEventView toEvent(const json& object) {
  GaitEventView event{object.at("event"), object.at("foot"), object.at("time_s")};
  event.source = object.value("source", "forces");
  const auto difference = object.find("marker_difference_s");
  if (difference != object.end() && !difference->is_null()) {
    event.marker_difference = difference->get<double>();
  }
  return event;
}

json toJson(const UnderstoodFile& file);

template <class T>
json toList(const std::vector<T>& values) {
  json list = json::array();
  for (const T& value : values) {
    list.push_back(toJson(value));
  }
  return list;
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
  if (!file.units.empty()) {
    object["units"] = file.units;
  }
  if (!file.labels_kind.empty()) {
    object[file.labels_kind] = file.labels;
  }
  if (file.labels_kind == "markers") {
    object["marker_sets"] = toList(file.marker_sets);
  }
  if (file.labels_kind == "forces") {
    object["contacts"] = toList(file.contacts);
  }
  if (file.emg) {
    object["emg"] = {{"source", file.emg->source},
                     {"channels", toList(file.emg->channels)},
                     {"force_channels", file.emg->force_channels}};
  }
  if (file.recording) {
    object["recording"] = {{"plates", toList(file.recording->plates)},
                           {"analog_channels", file.recording->analog_channels},
                           {"analog_rate_hz", file.recording->analog_rate},
                           {"events", toList(file.recording->events)}};
  }
  if (!file.marker_faults.empty()) {
    object["marker_faults"] = toList(file.marker_faults);
  }
  return object;
}

std::int64_t getInteger(const json& value) {
  gaitmill::require(value.is_number_integer(), ErrorCode::kStorage, "a count is no integer");
  return value.get<std::int64_t>();
}

void readLists(const json& object, UnderstoodFile& file) {
  for (const char* kind : {"markers", "forces", "columns", "muscles"}) {
    if (object.contains(kind)) {
      file.labels_kind = kind;
      file.labels = object.at(kind).get<std::vector<std::string>>();
    }
  }
  for (const json& match : object.value("marker_sets", json::array())) {
    file.marker_sets.push_back(toMarkerSetMatch(match));
  }
  for (const json& contact : object.value("contacts", json::array())) {
    file.contacts.push_back(toContact(contact));
  }
  if (object.contains("emg")) {
    file.emg = toEmg(object.at("emg"));
  }
  if (object.contains("recording")) {
    file.recording = toRecording(object.at("recording"));
  }
  for (const json& fault : object.value("marker_faults", json::array())) {
    file.marker_faults.push_back(toMarkerFault(fault));
  }
}

UnderstoodFile toFile(const json& object) {
  UnderstoodFile file;
  file.part = object.at("part");
  file.name = object.at("name");
  file.size = getInteger(object.at("size_bytes"));
  file.sha256 = object.at("sha256");
  file.format = object.at("format");
  if (object.contains("frames")) {
    file.frames = static_cast<int>(getInteger(object.at("frames")));
  }
  file.rate = getIfPresent<double>(object, "rate_hz");
  file.start = getIfPresent<double>(object, "start_s");
  file.end = getIfPresent<double>(object, "end_s");
  file.units = object.value("units", "");
  readLists(object, file);
  return file;
}

json markerNamesOrNull(const TrialView& trial) {
  return trial.marker_names ? toJson(*trial.marker_names) : json(nullptr);
}

}  // namespace

const std::vector<std::string>& trialParts() {
  static const std::vector<std::string> parts = {
      "markers", "grf", "static", "static2", "emg", "model", "coordinates", "marker_names"};
  return parts;
}

TrialSubject parseTrialSubject(const std::string& text) {
  const json object = parseJson(text, "trial");
  ObjectReader reader(object, "trial");
  TrialSubject subject;
  subject.mass = reader.number("mass_kg", kMassRange);
  subject.height = reader.number("height_m", kHeightRange);
  subject.marker_set = reader.optionalText("marker_set");
  subject.subject = reader.optionalText("subject").value_or("");
  subject.label = reader.optionalText("label").value_or("");
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
  const bool is_stored = !trial.id.empty();
  json object{{"id", textOrNull(trial.id)},
              {"created_at", nullptr},
              {"subject", textOrNull(trial.subject.subject)},
              {"label", textOrNull(trial.subject.label)},
              {"mass_kg", trial.subject.mass},
              {"height_m", trial.subject.height},
              {"marker_set", nullptr},
              {"options", json::parse(trial.subject.options)},
              {"files", toList(trial.files)},
              {"marker_names", markerNamesOrNull(trial)},
              {"events", toList(trial.events)},
              {"gait", json::parse(trial.gait)},
              {"decisions", json::parse(trial.decisions)},
              {"warnings", trial.warnings}};
  if (is_stored) {
    object["created_at"] = formatTimestamp(trial.created_at);
  }
  if (trial.subject.marker_set) {
    object["marker_set"] = *trial.subject.marker_set;
  }
  return dumpJson(object);
}

std::string encodeUnderstanding(const TrialView& trial) {
  return dumpJson({{"files", toList(trial.files)},
                   {"marker_names", markerNamesOrNull(trial)},
                   {"events", toList(trial.events)},
                   {"gait", json::parse(trial.gait)},
                   {"decisions", json::parse(trial.decisions)},
                   {"warnings", trial.warnings}});
}

void decodeUnderstanding(const std::string& text, TrialView& trial) {
  try {
    const json object = json::parse(text);
    trial.files.clear();
    for (const json& file : object.at("files")) {
      trial.files.push_back(toFile(file));
    }
    // Trials from before this was told have none.
    trial.marker_names.reset();
    const json names = object.value("marker_names", json(nullptr));
    if (!names.is_null()) {
      trial.marker_names = toMarkerNames(names);
    }
    trial.events.clear();
    for (const json& event : object.at("events")) {
      trial.events.push_back(toEvent(event));
    }
    trial.gait = object.contains("gait") ? object.at("gait").dump() : "null";
    trial.decisions = object.value("decisions", json::array()).dump();
    trial.warnings = object.at("warnings").get<std::vector<std::string>>();
  } catch (const json::exception&) {
    throw Error(ErrorCode::kStorage, "what was understood of a trial is damaged");
  }
}

}  // namespace gaitmill::api
