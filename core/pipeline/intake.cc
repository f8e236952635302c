#include "core/pipeline/intake.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/intake/angle_unit.h"
#include "core/intake/clock_offset.h"
#include "core/intake/force_reading.h"
#include "core/intake/landmarks.h"
#include "core/io/grf_reader.h"
#include "core/io/trc_reader.h"

namespace gaitmill {

namespace {

// TRC files are made for musculoskeletal models, whose Y is up.
constexpr SignedAxis kUsualVertical{1, 1};

// C3D files have the laboratory's axes, mostly Z up; they may say so.
SignedAxis findVertical(const C3dFile& file) {
  constexpr SignedAxis kUsual{2, 1};
  return file.up.empty() ? kUsual : SignedAxis{file.up[1] - 'X', file.up[0] == '+' ? 1 : -1};
}

std::string describeMissingPlates(const C3dFile& file) {
  std::string refusals;
  for (const C3dPlate& plate : file.plates) {
    refusals += (refusals.empty() ? ": " : "; ") + plate.name + ", " + plate.refusal;
  }
  return (file.plates.empty() ? std::string("the C3D file has no force plate")
                              : "no force plate of the C3D file can be read" + refusals) +
         "; without forces the stages scale and ik can be run";
}

void setPart(const std::string& part, std::size_t first, Decisions& decisions) {
  for (std::size_t i = first; i < decisions.size(); ++i) {
    decisions[i].part = part;
  }
}

bool isOnFoot(const Landmark& landmark) {
  return landmark.body.compare(0, 5, "calcn") == 0 || landmark.body.compare(0, 4, "toes") == 0;
}

void scale(double factor, MarkerTrajectories& markers) {
  if (factor != 1) {
    markers.positions *= factor;
  }
}

/// The frame of a file whose vertical axis is not the movement's: its heading is not known.
LaboratoryFrame makeUprightFrame(const SignedAxis& vertical) {
  LaboratoryFrame frame;
  frame.vertical = vertical;
  const Eigen::Vector3d forward = SignedAxis{vertical.axis == 0 ? 2 : 0, 1}.direction();
  frame.R = makeTurn(forward, vertical.direction());
  return frame;
}

double findLargestAngle(const TimeSeries& coordinates, const ModelSpec& model) {
  double largest = 0;
  for (int i = 0; i < coordinates.columnCount(); ++i) {
    const std::string& name = coordinates.labels[static_cast<std::size_t>(i)];
    // The heading of the pelvis says nothing: it may be anything, also in a movement of nothing.
    if (findMotionKind(model, name) == MotionKind::kRotational && name != "pelvis_rotation") {
      for (const double value : coordinates.values.col(i)) {
        largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
      }
    }
  }
  return largest;
}

}  // namespace

const InputFile* findForceFile(const TrialInput& input) {
  if (input.ground_reaction) {
    return &*input.ground_reaction;
  }
  return input.markers && isC3d(input.markers->bytes) ? &*input.markers : nullptr;
}

const InputFile* findEmgFile(const TrialInput& input) {
  if (input.emg) {
    return &*input.emg;
  }
  return input.markers && isC3d(input.markers->bytes) ? &*input.markers : nullptr;
}

BodyMarkers findBodyMarkers(const MarkerTrajectories& markers, const MarkerMapping& mapping) {
  BodyMarkers body;
  for (int i = 0; i < markers.markerCount(); ++i) {
    const MarkerName* name = mapping.find(markers.names[static_cast<std::size_t>(i)]);
    const Landmark* landmark =
        name == nullptr || name->landmark.empty() ? nullptr : findLandmark(name->landmark);
    if (landmark != nullptr && landmark->kind == LandmarkKind::kDerived) {
      continue;
    }
    if (landmark != nullptr && isOnFoot(*landmark)) {
      (landmark->side == Side::kRight ? body.right_foot : body.left_foot).push_back(i);
    } else {
      body.others.push_back(i);
    }
  }
  return body;
}

void Intake::warnAbout(const InputFile& file, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    warnings_.push_back(file.name + ": " + sentence);
  }
}

// Gaps are common and many; their sentences would drown the others.
void Intake::warnAboutFaults(const InputFile& file, const MarkerRepair& repair) {
  constexpr int kMostSentences = 20;
  int filled = 0;
  int left = 0;
  std::vector<std::string> sentences;
  for (const MarkerFault& fault : repair.faults) {
    if (fault.kind != MarkerFault::Kind::kGap) {
      sentences.push_back(describeFault(fault));
    } else {
      (fault.action == MarkerFault::Action::kFilled ? filled : left) += 1;
    }
  }
  if (sentences.size() > kMostSentences) {
    const std::size_t more = sentences.size() - kMostSentences;
    sentences.resize(kMostSentences);
    sentences.push_back(std::to_string(more) + " more faults of markers; see marker_faults");
  }
  if (filled + left > 0) {
    sentences.push_back(std::to_string(filled) + " gaps of markers were filled, " +
                        std::to_string(left) + " were left");
  }
  warnAbout(file, sentences);
}

MarkerReading Intake::readMarkers(const InputFile& file, const std::string& part) {
  const std::size_t first = decisions_.size();
  MarkerReading reading;
  if (isC3d(file.bytes)) {
    reading.recording = readC3d(file.bytes, file.name);
    warnAbout(file, reading.recording->warnings);
    reading.format = "c3d";
    reading.units = reading.recording->units;
    reading.markers = std::move(reading.recording->markers);
    require(reading.markers.markerCount() > 0,
            ErrorCode::kC3dData,
            "the file has no labelled point that is a marker",
            {file.name, 0, 0, "POINT:LABELS"});
  } else {
    TrcFile trc = readTrc(file.bytes, file.name, settings_.trc);
    warnAbout(file, trc.warnings);
    reading.format = "trc";
    reading.units = trc.units;
    reading.markers = std::move(trc.markers);
  }
  scale(decideMarkerUnit(reading.markers, reading.units, settings_.laboratory, decisions_),
        reading.markers);
  setPart(part, first, decisions_);
  reading.repair = repairMarkers(settings_.marker_faults, reading.markers);
  warnAboutFaults(file, reading.repair);
  return reading;
}

MarkerReading Intake::readMovement(const InputFile& file) {
  movement_bytes_ = file.bytes.data();
  MarkerReading reading = readMarkers(file, "markers");
  const std::size_t first = decisions_.size();
  body_ = findBodyMarkers(reading.markers, mapMarkerNames(reading.markers.names));
  try {
    const SignedAxis usual = reading.recording ? findVertical(*reading.recording) : kUsualVertical;
    frame_ = decideFrame(reading.markers, body_, settings_.laboratory, usual, decisions_);
  } catch (Error& error) {
    throw error.setFile(file.name);
  }
  setPart("markers", first, decisions_);
  applyFrame(*frame_, reading.markers);
  movement_ = reading.markers;
  return reading;
}

MarkerReading Intake::readStatic(const InputFile& file, const std::string& part) {
  MarkerReading reading = readMarkers(file, part);
  const std::size_t first = decisions_.size();
  const BodyMarkers body = findBodyMarkers(reading.markers, mapMarkerNames(reading.markers.names));
  const SignedAxis usual = reading.recording ? findVertical(*reading.recording)
                           : frame_          ? frame_->vertical
                                             : kUsualVertical;
  const SignedAxis vertical =
      decideVertical(reading.markers, body, settings_.laboratory, usual, decisions_);
  setPart(part, first, decisions_);
  const bool is_same =
      frame_ && vertical.axis == frame_->vertical.axis && vertical.sign == frame_->vertical.sign;
  applyFrame(is_same ? *frame_ : makeUprightFrame(vertical), reading.markers);
  return reading;
}

ForceReading Intake::readForces(const InputFile& file) {
  ForceReading reading;
  if (isC3d(file.bytes)) {
    C3dFile c3d = readC3d(file.bytes, file.name);
    // The movement's own file has said its warnings already.
    if (file.bytes.data() != movement_bytes_) {
      warnAbout(file, c3d.warnings);
    }
    require(!c3d.ground_reaction.forces.empty(),
            ErrorCode::kInputMissing,
            describeMissingPlates(c3d),
            {file.name, 0, 0, "grf"});
    reading.plates = std::move(c3d.ground_reaction);
    reading.feet.assign(reading.plates.forces.size(), Foot::kUnknown);
  } else {
    reading.table = readTable(file.bytes, file.name);
    warnAbout(file, reading.table->warnings);
    reading.plates = readForceColumns(*reading.table);
    reading.feet = findFamilyFeet(reading.table->table.labels);
  }
  std::vector<std::string> warnings;
  try {
    decideForces(movement_,
                 body_,
                 frame_ ? &*frame_ : nullptr,
                 settings_.force_reading,
                 reading.plates,
                 decisions_,
                 warnings);
    decideClock(movement_, body_, settings_.force_time_offset, reading.plates, decisions_);
  } catch (Error& error) {
    throw error.setFile(file.name);
  }
  warnAbout(file, warnings);
  return reading;
}

TimeSeries Intake::readCoordinates(const InputFile& file,
                                   const ModelSpec& model,
                                   std::vector<std::string>& ignored) {
  TableFile table = readTable(file.bytes, file.name);
  warnAbout(file, table.warnings);
  const double peak = findLargestAngle(toCoordinates(table, model, &ignored), model);
  const StatedAngles stated{table.in_degrees, table.degrees_stated};
  const double in_file = table.in_degrees ? toDegrees(peak) : peak;
  try {
    table.in_degrees = decideAngleUnit(in_file, stated, settings_.angles_in_degrees, decisions_);
  } catch (Error& error) {
    throw error.setFile(file.name);
  }
  ignored.clear();
  return toCoordinates(table, model, &ignored);
}

}  // namespace gaitmill
