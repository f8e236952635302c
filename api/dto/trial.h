#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill::api {

struct UploadedFile {
  std::string name;  ///< the client's file name without folders, for messages only
  std::string bytes;
};

/// Who was measured: the JSON part "trial" of an upload.
struct TrialSubject {
  double mass = 0;                        ///< [kg] "mass_kg", 5 to 300
  double height = 0;                      ///< [m] "height_m", 0.4 to 2.6
  std::optional<std::string> marker_set;  ///< name of a set-up under models/marker_sets
  std::string options = "{}";             ///< settings that hold for every job of this trial, JSON
};

/// The file parts a trial may have, in the order they are shown:
/// markers, grf, static, static2, emg, model, coordinates.
const std::vector<std::string>& trialParts();

struct TrialUpload {
  TrialSubject subject;
  std::map<std::string, UploadedFile> files;  ///< by part name
};

/// What the service read in one file. Numbers that do not apply to its kind are absent.
struct UnderstoodFile {
  std::string part;
  std::string name;
  std::int64_t size = 0;  ///< [bytes]
  std::string sha256;     ///< hex
  std::string format;     ///< "trc", "table", "osim"
  std::optional<int> frames;
  std::optional<double> rate;   ///< [Hz]
  std::optional<double> start;  ///< [s]
  std::optional<double> end;    ///< [s]
  std::string labels_kind;  ///< "markers", "forces", "columns" or "muscles"
  std::vector<std::string> labels;
};

struct TrialView {
  std::string id;
  std::int64_t created_at = 0;  ///< [ms since 1970 UTC]
  TrialSubject subject;
  std::vector<UnderstoodFile> files;
  std::vector<std::string> warnings;
};

/// Reads {"mass_kg", "height_m", "marker_set", "options"}; the last two may be absent.
/// @throws Error kRequestMalformed, kRequestField naming the field
TrialSubject parseTrialSubject(const std::string& json);

std::string renderTrial(const TrialView& trial);

/// The list of files as JSON and back: how a trial's reading is kept in storage.
std::string encodeUnderstoodFiles(const std::vector<UnderstoodFile>& files);
std::vector<UnderstoodFile> decodeUnderstoodFiles(const std::string& json);

}  // namespace gaitmill::api
