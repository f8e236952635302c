#include "service/inspection.h"

#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/io/emg_reader.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
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
  void read(const std::string& part, const UploadedFile& file);
  api::TrialView take() { return std::move(view_); }

 private:
  using Warnings = std::vector<std::string>;

  void inspect(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectMarkers(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void inspectForces(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings);
  void understand(const TableFile& table, UnderstoodFile& understood, Warnings& warnings);

  api::TrialView view_;
  MarkerTrajectories movement_;
};

const char* footName(Foot foot) {
  switch (foot) {
    case Foot::kRight:
      return "right";
    case Foot::kLeft:
      return "left";
    case Foot::kUnknown:
      break;
  }
  return "";
}

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
          contact.contact.has_toe_off};
}

api::GaitEventView makeEvent(const GaitEvent& event) {
  const bool is_strike = event.kind == GaitEvent::Kind::kFootStrike;
  return {is_strike ? "foot_strike" : "toe_off", footName(event.foot), event.time};
}

void Inspection::inspectMarkers(const OpenedFile& file,
                                UnderstoodFile& understood,
                                Warnings& warnings) {
  TrcFile trc = readTrc(file.bytes, file.name);
  understood.format = "trc";
  putTimes(trc.markers.time, understood);
  if (trc.markers.rate > 0) {
    understood.rate = trc.markers.rate;
  }
  understood.units = trc.units;
  understood.labels_kind = "markers";
  understood.labels = trc.markers.names;
  warnings = trc.warnings;
  if (understood.part == "markers") {
    movement_ = std::move(trc.markers);
  }
}

void Inspection::inspectForces(const OpenedFile& file,
                               UnderstoodFile& understood,
                               Warnings& warnings) {
  const TableFile table = inspectTable(file, understood);
  understood.labels_kind = "forces";
  understood.labels = findForceFamilies(table.table.labels);
  require(!understood.labels.empty(),
          ErrorCode::kGrfColumns,
          "no column is a ground reaction force such as ground_force_r_vx",
          {file.name, 0, 0, ""});
  warnings = table.warnings;
  try {
    understand(table, understood, warnings);
  } catch (const Error& error) {
    warnings.push_back("contacts cannot be told: " + error.message());
  }
}

void Inspection::understand(const TableFile& table,
                            UnderstoodFile& understood,
                            Warnings& warnings) {
  const ForceUnderstanding forces = understandForces(table, movement_);
  for (const FootContact& contact : forces.contacts) {
    understood.contacts.push_back(makeContact(contact));
  }
  for (const GaitEvent& event : forces.events) {
    view_.events.push_back(makeEvent(event));
  }
  warnings.insert(warnings.end(), forces.warnings.begin(), forces.warnings.end());
}

void Inspection::inspect(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  if (understood.part == "model") {
    inspectModel(file, understood, warnings);
  } else if (understood.part == "grf") {
    inspectForces(file, understood, warnings);
  } else if (understood.part == "emg") {
    inspectEmg(file, understood, warnings);
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

}  // namespace

api::TrialView inspectTrial(const api::TrialUpload& upload) {
  Inspection inspection;
  for (const std::string& part : api::trialParts()) {
    const auto found = upload.files.find(part);
    if (found != upload.files.end()) {
      inspection.read(part, found->second);
    }
  }
  return inspection.take();
}

}  // namespace gaitmill
