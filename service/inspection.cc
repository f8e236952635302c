#include "service/inspection.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"

namespace gaitmill {

namespace {

using api::UnderstoodFile;
using api::UploadedFile;
using Warnings = std::vector<std::string>;

void putTimes(const std::vector<double>& time, UnderstoodFile& understood) {
  understood.frames = static_cast<int>(time.size());
  understood.start = time.front();
  understood.end = time.back();
  if (time.size() > 1 && time.back() > time.front()) {
    understood.rate = static_cast<double>(time.size() - 1) / (time.back() - time.front());
  }
}

// A file as the parsers take it.
struct OpenedFile {
  std::string name;
  std::string bytes;
};

OpenedFile open(const UploadedFile& file) {
  return {file.name, api::readAll(*file.bytes, kMaximumFileSize)};
}

void inspectMarkers(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  const TrcFile trc = readTrc(file.bytes, file.name);
  understood.format = "trc";
  putTimes(trc.markers.time, understood);
  if (trc.markers.rate > 0) {
    understood.rate = trc.markers.rate;
  }
  understood.labels_kind = "markers";
  understood.labels = trc.markers.names;
  warnings = trc.warnings;
}

void inspectTable(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  const TableFile table = readTable(file.bytes, file.name);
  understood.format = "table";
  putTimes(table.table.time, understood);
  understood.labels_kind = "columns";
  understood.labels = table.table.labels;
  warnings = table.warnings;
}

// Which foot a numbered plate belongs to is settled by the job's settings, so only the columns are
// looked at here.
void inspectGroundReaction(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  inspectTable(file, understood, warnings);
  understood.labels_kind = "forces";
  understood.labels = findForceFamilies(understood.labels);
  require(!understood.labels.empty(),
          ErrorCode::kGrfColumns,
          "no column is a ground reaction force such as ground_force_r_vx",
          {file.name, 0, 0, ""});
}

void inspectModel(const OpenedFile& file, UnderstoodFile& understood, Warnings& warnings) {
  const ModelSpec model = readOsim(file.bytes, file.name, &warnings);
  understood.format = "osim";
  understood.labels_kind = "muscles";
  for (const MuscleSpec& muscle : model.muscles) {
    understood.labels.push_back(muscle.name);
  }
}

using Inspector = std::function<void(const OpenedFile&, UnderstoodFile&, Warnings&)>;

const Inspector& findInspector(const std::string& part) {
  static const std::map<std::string, Inspector> inspectors = {{"markers", inspectMarkers},
                                                              {"grf", inspectGroundReaction},
                                                              {"static", inspectMarkers},
                                                              {"static2", inspectMarkers},
                                                              {"emg", inspectTable},
                                                              {"model", inspectModel},
                                                              {"coordinates", inspectTable}};
  return inspectors.at(part);
}

}  // namespace

api::TrialView inspectTrial(const api::TrialUpload& upload) {
  api::TrialView view;
  for (const std::string& part : api::trialParts()) {
    const auto found = upload.files.find(part);
    if (found == upload.files.end()) {
      continue;
    }
    const UploadedFile& file = found->second;
    UnderstoodFile understood;
    understood.part = part;
    understood.name = file.name;
    Warnings warnings;
    try {
      findInspector(part)(open(file), understood, warnings);
    } catch (Error& error) {
      error.addContext("reading the part '" + part + "'");
      throw;
    }
    view.files.push_back(understood);
    for (const std::string& warning : warnings) {
      view.warnings.push_back(file.name + ": " + warning);
    }
  }
  return view;
}

}  // namespace gaitmill
