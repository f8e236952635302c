#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/marker_names.h"
#include "api/http.h"

namespace gaitmill::api {

struct UploadedFile {
  std::string name;  ///< the client's file name without folders, for messages only
  std::shared_ptr<const ByteSource> bytes;
};

/// Who was measured: the JSON part "trial" of an upload.
struct TrialSubject {
  double mass = 0;                        ///< [kg] "mass_kg", 5 to 300
  double height = 0;                      ///< [m] "height_m", 0.4 to 2.6
  std::optional<std::string> marker_set;  ///< a shipped set's name, or "mks_…"
  std::string options = "{}";             ///< settings that hold for every job of this trial, JSON
  std::string subject;                    ///< the lab's own name for the person, to find it again
  std::string label;                      ///< the lab's own name for the trial
};

/// The file parts a trial may have, in the order they are shown:
/// markers, grf, static, static2, emg, model, coordinates, marker_names.
const std::vector<std::string>& trialParts();

struct TrialUpload {
  TrialSubject subject;
  std::map<std::string, UploadedFile> files;  ///< by part name
  std::string submission_key;                 ///< the request's Idempotency-Key, or empty
};

/// Markers of one file against one known marker set.
struct MarkerSetMatch {
  std::string marker_set;
  std::vector<std::string> found;
  std::vector<std::string> missing;  ///< that the set's inverse kinematics asks for
};

/// One contact of one force plate or force column family with the ground.
struct ContactView {
  std::string plate;   ///< as the columns name it
  std::string foot;    ///< "right", "left", or empty if it cannot be told
  double strike = 0;   ///< [s]; start of the record if it began before
  double toe_off = 0;  ///< [s]; end of the record if it goes on
  bool has_strike = false;
  bool has_toe_off = false;
  double confidence = 0;                ///< that the foot is right, 0 to 1
  std::string reason = {};              ///< the evidence
  std::vector<std::string> flags = {};  ///< "stated", "shared", "partial", "outside_sole",
                                        ///< "wrong_foot"
};

/// One channel of an EMG recording and what it is taken for.
struct EmgChannelView {
  std::string channel;
  std::string side;                  ///< "right", "left"
  std::vector<std::string> muscles;  ///< empty if its name says nothing
};

struct EmgView {
  std::string source;  ///< "raw" or "envelope"
  std::vector<EmgChannelView> channels;
  std::vector<std::string> force_channels;  ///< of force plates in the same file, left out
};

/// A force plate that a C3D file describes.
struct PlateView {
  std::string name;     ///< "plate_1"
  int type = 0;         ///< as the format numbers types
  std::string refusal;  ///< why its forces cannot be read; empty if they are
};

/// An event that a person or a program marked in the recording.
struct MarkedEventView {
  std::string label;    ///< "Foot Strike"
  std::string context;  ///< "Left"
  double time = 0;      ///< [s]
};

/// What a C3D file holds beside its markers.
struct RecordingView {
  std::vector<PlateView> plates;
  std::vector<std::string> analog_channels;  ///< that belong to no plate
  double analog_rate = 0;                    ///< [Hz]; 0 without channels
  std::vector<MarkedEventView> events;       ///< by time
};

/// Something wrong with a marker over some frames.
struct MarkerFaultView {
  std::string fault;   ///< "gap", "swap", "spike", "drift"
  std::string action;  ///< "reported", "filled", "corrected", "removed", "weight_lowered"
  std::string marker;
  std::string other;  ///< the second marker of a swap, or empty
  double start = 0;   ///< [s]
  double end = 0;     ///< [s]
  int frames = 0;
  std::optional<double> size;  ///< [m] how far it is off; none for gaps
};

/// What the service read in one file. Numbers that do not apply to its kind are absent.
struct UnderstoodFile {
  std::string part;
  std::string name;
  std::int64_t size = 0;  ///< [bytes]
  std::string sha256;     ///< hex
  std::string format;     ///< "trc", "c3d", "table", "anc", "osim", "json"
  std::optional<int> frames;
  std::optional<double> rate;   ///< [Hz]
  std::optional<double> start;  ///< [s]
  std::optional<double> end;    ///< [s]
  std::string units;        ///< of lengths as the file states them: "mm", "m"; empty if it does not
  std::string labels_kind;  ///< "markers", "forces", "columns" or "muscles"
  std::vector<std::string> labels;
  std::vector<MarkerSetMatch> marker_sets;     ///< of marker files, best match first
  std::vector<ContactView> contacts;           ///< of ground reactions
  std::optional<EmgView> emg;                  ///< of EMG
  std::optional<RecordingView> recording;      ///< of C3D files
  std::vector<MarkerFaultView> marker_faults;  ///< of marker files
};

struct GaitEventView {
  std::string kind;               ///< "foot_strike", "toe_off"
  std::string foot;               ///< "right", "left"
  double time = 0;                ///< [s]
  std::string source = "forces";  ///< or "markers"
  /// Time by the markers minus time by the forces [s], where both know the event.
  std::optional<double> marker_difference = {};
};

struct TrialView {
  std::string id;               ///< empty after a dry run
  std::int64_t created_at = 0;  ///< [ms since 1970 UTC]
  TrialSubject subject;
  std::vector<UnderstoodFile> files;
  std::optional<MarkerNamesView> marker_names;  ///< absent without marker files
  std::vector<GaitEventView> events;            ///< by time
  /// Kind of gait, cycles, complete forces and the default window, as JSON of the core; "null"
  /// without movement and forces.
  std::string gait = "null";
  /// What was read out of the data rather than stated, as a JSON list of the core.
  std::string decisions = "[]";
  std::vector<std::string> warnings;
};

/// Reads {"mass_kg", "height_m", "marker_set", "options", "subject", "label"}; all but the first
/// two may be absent.
/// @throws Error kRequestMalformed, kRequestField naming the field
TrialSubject parseTrialSubject(const std::string& json);

std::string renderTrial(const TrialView& trial);

/// What was understood (files, marker names, events, warnings) as JSON and back: how a trial's
/// reading is kept in storage, and how it comes back from the process that reads hostile bytes.
std::string encodeUnderstanding(const TrialView& trial);
/// @throws Error kStorage if the text is no such JSON
void decodeUnderstanding(const std::string& json, TrialView& trial);

}  // namespace gaitmill::api
