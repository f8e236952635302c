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

// A file as the parsers take it.
struct OpenedFile {
  std::string name;
  std::string bytes;
};

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

  void inspect(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectMarkers(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectForces(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void understand(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void put(const Gait& gait);

  void nameMarkers();

  api::TrialView view_;
  PipelineSettings settings_;
  Intake intake_{settings_};
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

TableFile inspectTable(const OpenedFile& file, UnderstoodFile& understood) {
  TableFile table = readTable(file.bytes, file.name);
  understood.format = "table";
  putTimes(table.table.time, understood);
  understood.labels_kind = "columns";
  understood.labels = table.table.labels;
  return table;
}

void inspectModel(const OpenedFile& file,
                  UnderstoodFile& understood,
                  std::vector<std::string>& warnings) {
  const ModelSpec model = readOsim(file.bytes, file.name, &warnings);
  understood.format = "osim";
  understood.labels_kind = "muscles";
  for (const MuscleSpec& muscle : model.muscles) {
    understood.labels.push_back(muscle.name);
  }
}

void inspectEmg(const OpenedFile& file,
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

void putMarkerFaults(MarkerTrajectories& markers, UnderstoodFile& understood) {
  constexpr std::size_t kMostFaults = 200;
  const MarkerRepair repair = repairMarkers({}, markers);
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

MarkerTrajectories readMarkerFile(const OpenedFile& file,
                                  UnderstoodFile& understood,
                                  std::vector<std::string>& warnings) {
  if (!isC3d(file.bytes)) {
    TrcFile trc = readTrc(file.bytes, file.name);
    understood.format = "trc";
    understood.units = trc.units;
    warnings = std::move(trc.warnings);
    return std::move(trc.markers);
  }
  C3dFile c3d = readC3d(file.bytes, file.name);
  understood.format = "c3d";
  understood.units = c3d.units;
  understood.recording = makeRecording(c3d);
  warnings = std::move(c3d.warnings);
  return std::move(c3d.markers);
}

MarkerTrajectories readInGround(Intake& intake,
                                const OpenedFile& file,
                                std::vector<std::string>& warnings) {
  try {
    return intake.readMovement({file.name, file.bytes}).markers;
  } catch (const Error& error) {
    warnings.push_back("the gait cannot be told: " + error.message());
    return {};
  }
}

void Inspection::inspectMarkers(const OpenedFile& file,
                                UnderstoodFile& understood,
                                Warnings& warnings) {
  MarkerTrajectories markers = readMarkerFile(file, understood, warnings);
  putTimes(markers.time, understood);
  if (markers.rate > 0) {
    understood.rate = markers.rate;
  }
  understood.labels_kind = "markers";
  understood.labels = markers.names;
  putMarkerFaults(markers, understood);
  for (const std::string& name : understood.labels) {
    if (std::find(marker_names_.begin(), marker_names_.end(), name) == marker_names_.end()) {
      marker_names_.push_back(name);
    }
  }
  if (understood.part == "markers") {
    movement_ = readInGround(intake_, file, warnings);
    put(understandMovement(movement_));  // until forces tell more
  }
}

// Feet and contacts of its plates need the laboratory's axes, which the job settles.
void inspectPlates(const OpenedFile& file,
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

void Inspection::inspectForces(const OpenedFile& file,
                               UnderstoodFile& understood,
                               Warnings& warnings) {
  if (isC3d(file.bytes)) {
    inspectPlates(file, understood, warnings);
    return;
  }
  const TableFile table = inspectTable(file, understood);
  understood.labels_kind = "forces";
  understood.labels = findForceFamilies(table.table.labels);
  require(!understood.labels.empty(),
          ErrorCode::kGrfColumns,
          "no column is a ground reaction force such as ground_force_r_vx",
          {file.name, 0, 0, ""});
  warnings = table.warnings;
  try {
    understand(file, understood, warnings);
  } catch (const Error& error) {
    warnings.push_back("contacts cannot be told: " + error.message());
  }
}

void Inspection::understand(const OpenedFile& file,
                            UnderstoodFile& understood,
                            Warnings& warnings) {
  const Gait gait =
      understandForces(intake_.readForces({file.name, file.bytes}), movement_, warnings);
  for (const FootContact& contact : gait.contacts) {
    understood.contacts.push_back(makeContact(contact));
  }
  warnings.insert(warnings.end(), gait.warnings.begin(), gait.warnings.end());
  put(gait);
}

void Inspection::put(const Gait& gait) {
  view_.events.clear();
  for (const GaitEvent& event : gait.events) {
    view_.events.push_back(makeEvent(event));
  }
  view_.gait = describeAsJson(gait);
}

void Inspection::inspect(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  if (understood.part == "model") {
    inspectModel(file, understood, warnings);
  } else if (understood.part == "grf") {
    inspectForces(file, understood, warnings);
  } else if (understood.part == "emg") {
    inspectEmg(file, understood, warnings);
  } else if (understood.part == "marker_names") {
    understood.format = "json";
    stated_names_ = readMarkerNames({file.name, file.bytes});
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
