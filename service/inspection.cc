#include "service/inspection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/intake/marker_faults.h"
#include "core/intake/marker_names.h"
#include "core/io/c3d_reader.h"
#include "core/io/emg_reader.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "core/pipeline/decisions_json.h"
#include "core/pipeline/gait_reading.h"
#include "core/pipeline/intake.h"
#include "core/pipeline/marker_names_json.h"
#include "core/pipeline/understanding.h"

namespace gaitmill {

namespace {

using api::UnderstoodFile;
using api::UploadedFile;

// Reads the parts in the order of api::trialParts(), the movement before the forces, because the
// markers tell which foot stands on a numbered plate.
class Inspection {
 public:
  /// @param options  settings that hold for every job of the trial
  explicit Inspection(PipelineSettings options) : settings_(std::move(options)) {}
  void read(const std::string& part, const UploadedFile& file);
  api::TrialView take();

 private:
  using Warnings = std::vector<std::string>;

  void inspect(const InputFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectMarkers(const InputFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectForces(const InputFile& file, UnderstoodFile& understood, Warnings& warnings);
  MarkerReading readMarkers(const InputFile& file, const std::string& part, Warnings& warnings);
  void understand(ForceReading forces, UnderstoodFile& understood, Warnings& warnings);
  void put(const Gait& gait);

  void nameMarkers();

  api::TrialView view_;
  PipelineSettings settings_;
  Intake intake_{settings_};
  std::size_t told_ = 0;  // of the intake's warnings
  MarkerTrajectories movement_;
  std::vector<std::string> marker_names_;  // of static poses and movement, each once
  MarkerOverrides stated_names_;
};

void putTimes(const std::vector<double>& time, UnderstoodFile& understood) {
  understood.frames = static_cast<int>(time.size());
  understood.start = time.front();
  understood.end = time.back();
  if (time.size() > 1 && time.back() > time.front()) {
    understood.rate = static_cast<double>(time.size() - 1) / (time.back() - time.front());
  }
}

void putTable(const TableFile& table, UnderstoodFile& understood) {
  understood.format = "table";
  putTimes(table.table.time, understood);
  understood.labels_kind = "columns";
  understood.labels = table.table.labels;
}

TableFile inspectTable(const InputFile& file, UnderstoodFile& understood) {
  TableFile table = readTable(file.bytes, file.name);
  putTable(table, understood);
  return table;
}

void inspectModel(const InputFile& file,
                  UnderstoodFile& understood,
                  std::vector<std::string>& warnings) {
  const ModelSpec model = readOsim(file.bytes, file.name, &warnings);
  understood.format = "osim";
  understood.labels_kind = "muscles";
  for (const MuscleSpec& muscle : model.muscles) {
    understood.labels.push_back(muscle.name);
  }
}

void inspectEmg(const InputFile& file,
                UnderstoodFile& understood,
                std::vector<std::string>& warnings) {
  const EmgFile recording = readEmg(file.bytes, file.name);
  const EmgUnderstanding emg = understandEmg(recording.signals);
  understood.format = recording.format;
  putTimes(recording.signals.time, understood);
  understood.labels_kind = "columns";
  understood.labels = recording.signals.labels;
  understood.emg = api::EmgView{
      emg.source == EmgSource::kRaw ? "raw" : "envelope", {}, recording.force_channels};
  for (const EmgChannel& channel : emg.channels) {
    understood.emg->channels.push_back({channel.channel, sideName(channel.side), channel.muscles});
  }
  warnings = recording.warnings;
  warnings.insert(warnings.end(), emg.warnings.begin(), emg.warnings.end());
}

api::ContactView makeContact(const FootContact& contact) {
  return {contact.plate,
          footName(contact.foot),
          contact.contact.strike,
          contact.contact.toe_off,
          contact.contact.has_strike,
          contact.contact.has_toe_off,
          contact.confidence,
          contact.reason,
          listFlags(contact)};
}

api::GaitEventView makeEvent(const GaitEvent& event) {
  const bool is_strike = event.kind == GaitEvent::Kind::kFootStrike;
  api::GaitEventView view{is_strike ? "foot_strike" : "toe_off", footName(event.foot), event.time};
  view.source = event.source == GaitEvent::Source::kForces ? "forces" : "markers";
  if (std::isfinite(event.marker_difference)) {
    view.marker_difference = event.marker_difference;
  }
  return view;
}

api::RecordingView makeRecording(const C3dFile& file) {
  api::RecordingView view;
  for (const C3dPlate& plate : file.plates) {
    view.plates.push_back({plate.name, plate.type, plate.refusal});
  }
  view.analog_channels = file.analog.labels;
  view.analog_rate = file.analog_rate;
  for (const C3dEvent& event : file.events) {
    view.events.push_back({event.label, event.context, event.time});
  }
  return view;
}

api::MarkerNamesView makeMarkerNames(const MarkerMapping& mapping) {
  api::MarkerNamesView view;
  view.set = mapping.set;
  view.set_share = mapping.set_share;
  for (const MarkerName& name : mapping.names) {
    view.markers.push_back({name.measured,
                            name.landmark,
                            name.confidence,
                            name.reason,
                            name.set,
                            name.proposal,
                            name.proposal_confidence});
  }
  for (MissingLandmarks& group : listMissingLandmarks(mapping)) {
    view.missing.push_back({std::move(group.part), group.needed, group.found, group.any_of});
  }
  return view;
}

void putMarkerFaults(const MarkerRepair& repair, UnderstoodFile& understood) {
  constexpr std::size_t kMostFaults = 200;
  for (const MarkerFault& fault : repair.faults) {
    if (understood.marker_faults.size() == kMostFaults) {
      return;
    }
    understood.marker_faults.push_back(
        {faultName(fault.kind),
         actionName(fault.action),
         fault.marker,
         fault.other,
         fault.start,
         fault.end,
         fault.last_frame - fault.first_frame + 1,
         std::isnan(fault.size) ? std::nullopt : std::optional<double>(fault.size)});
  }
}

/// A marker file as it stands: what can be told where the data allow two readings.
MarkerReading readAsItStands(const InputFile& file) {
  MarkerReading reading;
  if (isC3d(file.bytes)) {
    reading.recording = readC3d(file.bytes, file.name);
    reading.format = "c3d";
    reading.units = reading.recording->units;
    reading.markers = std::move(reading.recording->markers);
  } else {
    TrcFile trc = readTrc(file.bytes, file.name);
    reading.format = "trc";
    reading.units = trc.units;
    reading.markers = std::move(trc.markers);
  }
  return reading;
}

MarkerReading Inspection::readMarkers(const InputFile& file,
                                      const std::string& part,
                                      Warnings& warnings) {
  try {
    return part == "markers" ? intake_.readMovement(file) : intake_.readStatic(file, part);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInputAmbiguous) {
      throw;
    }
    warnings.push_back("the gait cannot be told: " + error.message());
    return readAsItStands(file);
  }
}

void Inspection::inspectMarkers(const InputFile& file,
                                UnderstoodFile& understood,
                                Warnings& warnings) {
  MarkerReading reading = readMarkers(file, understood.part, warnings);
  understood.format = reading.format;
  understood.units = reading.units;
  if (reading.recording) {
    understood.recording = makeRecording(*reading.recording);
  }
  putTimes(reading.markers.time, understood);
  if (reading.markers.rate > 0) {
    understood.rate = reading.markers.rate;
  }
  understood.labels_kind = "markers";
  understood.labels = reading.markers.names;
  putMarkerFaults(reading.repair, understood);
  for (const std::string& name : understood.labels) {
    if (std::find(marker_names_.begin(), marker_names_.end(), name) == marker_names_.end()) {
      marker_names_.push_back(name);
    }
  }
  if (understood.part == "markers") {
    movement_ = std::move(reading.markers);
    put(understandMovement(movement_));  // until forces tell more
  }
}

// Feet and contacts of its plates need the laboratory's axes, which the job settles.
void inspectPlates(const InputFile& file,
                   UnderstoodFile& understood,
                   std::vector<std::string>& warnings) {
  C3dFile c3d = readC3d(file.bytes, file.name);
  understood.format = "c3d";
  understood.recording = makeRecording(c3d);
  understood.labels_kind = "forces";
  for (const ExternalForce& force : c3d.ground_reaction.forces) {
    understood.labels.push_back(force.name);
  }
  require(!understood.labels.empty(),
          ErrorCode::kGrfColumns,
          "the file has no force plate that can be read",
          {file.name, 0, 0, ""});
  putTimes(c3d.ground_reaction.time, understood);
  warnings = std::move(c3d.warnings);
}

void Inspection::inspectForces(const InputFile& file,
                               UnderstoodFile& understood,
                               Warnings& warnings) {
  if (isC3d(file.bytes)) {
    inspectPlates(file, understood, warnings);
    return;
  }
  std::optional<ForceReading> forces;
  try {
    forces = intake_.readForces(file);
    putTable(*forces->table, understood);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInputAmbiguous) {
      throw;
    }
    inspectTable(file, understood);
    warnings.push_back("contacts cannot be told: " + error.message());
  }
  understood.labels_kind = "forces";
  understood.labels = findForceFamilies(understood.labels);
  if (forces) {
    understand(std::move(*forces), understood, warnings);
  }
}

// Forces that can be read but are not what a job expects are a warning: settings may leave their
// plate out.
void Inspection::understand(ForceReading forces, UnderstoodFile& understood, Warnings& warnings) {
  try {
    const Gait gait = understandForces(std::move(forces), movement_, warnings);
    for (const FootContact& contact : gait.contacts) {
      understood.contacts.push_back(makeContact(contact));
    }
    warnings.insert(warnings.end(), gait.warnings.begin(), gait.warnings.end());
    put(gait);
  } catch (const Error& error) {
    warnings.push_back("contacts cannot be told: " + error.message());
  }
}

void Inspection::put(const Gait& gait) {
  view_.events.clear();
  for (const GaitEvent& event : gait.events) {
    view_.events.push_back(makeEvent(event));
  }
  view_.gait = describeAsJson(gait);
}

void Inspection::inspect(const InputFile& file, UnderstoodFile& understood, Warnings& warnings) {
  if (understood.part == "model") {
    inspectModel(file, understood, warnings);
  } else if (understood.part == "grf") {
    inspectForces(file, understood, warnings);
  } else if (understood.part == "emg") {
    inspectEmg(file, understood, warnings);
  } else if (understood.part == "marker_names") {
    understood.format = "json";
    stated_names_ = readMarkerNames(file);
  } else if (understood.part == "coordinates") {
    warnings = inspectTable(file, understood).warnings;
  } else {
    inspectMarkers(file, understood, warnings);
  }
}

void Inspection::read(const std::string& part, const UploadedFile& file) {
  UnderstoodFile understood;
  understood.part = part;
  understood.name = file.name;
  Warnings warnings;
  try {
    inspect({file.name, api::readAll(*file.bytes, kMaximumFileSize)}, understood, warnings);
  } catch (Error& error) {
    error.addContext("reading the part '" + part + "'");
    throw;
  }
  view_.files.push_back(std::move(understood));
  // The intake names the file itself.
  const std::vector<std::string>& told = intake_.warnings();
  view_.warnings.insert(
      view_.warnings.end(), told.begin() + static_cast<std::ptrdiff_t>(told_), told.end());
  told_ = told.size();
  for (const std::string& warning : warnings) {
    view_.warnings.push_back(file.name + ": " + warning);
  }
}

// A statement about a marker that is not there is refused by the job; an upload may come in pieces.
void Inspection::nameMarkers() {
  if (marker_names_.empty()) {
    return;
  }
  MarkerMapping mapping;
  try {
    mapping = mapMarkerNames(marker_names_, stated_names_);
  } catch (const Error& error) {
    view_.warnings.push_back(error.where().field + ": " + error.message());
    mapping = mapMarkerNames(marker_names_);
  }
  view_.marker_names = makeMarkerNames(mapping);
  view_.warnings.insert(view_.warnings.end(), mapping.warnings.begin(), mapping.warnings.end());
}

api::TrialView Inspection::take() {
  nameMarkers();
  view_.decisions = describeAsJson(intake_.decisions());
  return std::move(view_);
}

}  // namespace

namespace {

/// Options that no job will take are told when a job is submitted; the files are read without them.
PipelineSettings readOptions(const std::string& options) {
  try {
    return readSettings({"options", options});
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

api::TrialView inspectTrial(const api::TrialUpload& upload) {
  Inspection inspection(readOptions(upload.subject.options));
  for (const std::string& part : api::trialParts()) {
    const auto found = upload.files.find(part);
    if (found != upload.files.end()) {
      inspection.read(part, found->second);
    }
  }
  return inspection.take();
}

}  // namespace gaitmill
