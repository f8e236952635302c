#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/data/decision.h"
#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/intake/laboratory.h"
#include "core/intake/marker_faults.h"
#include "core/intake/marker_names.h"
#include "core/io/c3d_reader.h"
#include "core/io/table_reader.h"
#include "core/pipeline/pipeline.h"
#include "core/pipeline/settings.h"

namespace gaitmill {

/// A marker file in ground axes and metres.
struct MarkerReading {
  MarkerTrajectories markers;
  std::string format;   ///< "trc" or "c3d"
  std::string units;    ///< that the file states
  MarkerRepair repair;  ///< what was wrong with the markers
  /// What a C3D file holds beside its markers, which are left out here; forces in its own axes.
  std::optional<C3dFile> recording;
};

/// Forces of all plates in ground axes, N, m and N.m on the subject, on the markers' clock. Nothing
/// is zeroed yet and no plate belongs to a foot.
struct ForceReading {
  GroundReaction plates;
  std::vector<Foot> feet;          ///< one per plate: what its name says
  std::optional<TableFile> table;  ///< that they came in, for messages; not of C3D files
};

/// The file that a trial's forces are in: the part "grf", else the movement's if that is a C3D
/// file; null if there is none.
const InputFile* findForceFile(const TrialInput& input);
/// Likewise of the EMG.
const InputFile* findEmgFile(const TrialInput& input);

/// Reads the recordings of a trial and brings them into ground, SI units and one time. Uploads and
/// jobs read by the same one, so that a job computes from what the upload's answer has said.
///
/// The movement comes first: its laboratory frame holds for all other files.
class Intake {
 public:
  /// @param settings  outlives the intake; what they state is not guessed
  explicit Intake(const PipelineSettings& settings) : settings_(settings) {}

  /// @throws Error of the reader; kInputAmbiguous where the data allow two readings
  MarkerReading readMovement(const InputFile& file);
  /// @param part  "static", for messages and decisions
  MarkerReading readStatic(const InputFile& file, const std::string& part);
  /// A table of forces, or the plates of a C3D file.
  ForceReading readForces(const InputFile& file);
  /// A table of coordinates [rad|m]: the angles' unit is checked against the data.
  /// @param ignored  labels that are no coordinates
  TimeSeries readCoordinates(const InputFile& file,
                             const ModelSpec& model,
                             std::vector<std::string>& ignored);

  /// Everything that the files left open, in the order in which they were read.
  const Decisions& decisions() const { return decisions_; }
  /// Sentences about one file begin with its name.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  MarkerReading readMarkers(const InputFile& file, const std::string& part);
  void warnAboutFaults(const InputFile& file, const MarkerRepair& repair);
  void warnAbout(const InputFile& file, const std::vector<std::string>& sentences);

  const PipelineSettings& settings_;
  std::optional<LaboratoryFrame> frame_;  ///< of the movement
  MarkerTrajectories movement_;
  const char* movement_bytes_ = nullptr;  ///< tells the movement's file from another
  BodyMarkers body_;                      ///< of the movement
  Decisions decisions_;
  std::vector<std::string> warnings_;
};

/// Which markers sit on the feet.
BodyMarkers findBodyMarkers(const MarkerTrajectories& markers, const MarkerMapping& mapping);

}  // namespace gaitmill
