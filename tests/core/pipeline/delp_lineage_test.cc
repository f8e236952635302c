// The published running trial of Hamner et al. (2010) through their own model, whose muscles are
// Thelen's and whose knee extensors end on moving points: raw files to muscle activations.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

// One stride after the third right contact; strength and speed of the muscles as published.
constexpr const char* kSettings = R"({
  "name": "hamner2010",
  "rra": {"lowpass_cutoff_hz": 15, "time_range_s": [0.7, 1.6]},
  "strength": {"law": "none", "max_contraction_velocity": 10},
  "so": {"time_range_s": [0.72, 1.58]},
  "cmc": {"time_range_s": [0.72, 1.59]}
})";

class HamnerTrialTest : public SharedDataTest {
 protected:
  InputFile open(const std::string& path) const { return {path, readFile(path)}; }
  PipelineResult run() const {
    const std::string trial = shared("data/run/hamner2010/");
    TrialInput input;
    input.model = open(shared("data/models/FullBodyModel_Hamner2010_v2_0.osim"));
    input.marker_set = open("tests/core/pipeline/hamner2010_marker_set.json");
    input.static_markers = open(trial + "subject02_static.trc");
    input.markers = open(trial + "subject02_running.trc");
    input.ground_reaction = open(trial + "subject02_running_grf.mot");
    input.mass = 65.9;
    input.height = 1.83;
    return Pipeline().run(input, {"hamner2010.json", kSettings}, {});
  }
  TimeSeries readReference(const ModelSpec& model) const {
    const std::string file = shared("data/run/hamner2010/reference/subject02_running_ik.mot");
    return toCoordinates(readTable(readFile(file), file), model);
  }
};

/// Standard deviation of the difference of one column over the rows of `a`.
double calcSpread(const TimeSeries& a, const TimeSeries& b, const std::string& label) {
  const int column_a = a.getColumn(label);
  const int column_b = b.getColumn(label);
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (int row = 0; row < a.rowCount(); ++row) {
    const double t = a.time[static_cast<std::size_t>(row)];
    if (t >= b.time.front() && t <= b.time.back()) {
      const double d = a.values(row, column_a) - b.interpolate(t)[column_b];
      sum += d;
      squares += d * d;
      ++count;
    }
  }
  return std::sqrt(squares / count - sum * sum / count / count);
}

TEST_F(HamnerTrialTest, RunsFromRawFilesToActivationsOfThelenMuscles) {
  const PipelineResult result = run();
  const nlohmann::json summary = nlohmann::json::parse(result.summary_json);
  EXPECT_TRUE(summary["stages"]["cmc"]["finished"].get<bool>());
  EXPECT_TRUE(summary["quality"]["infeasible_windows"].empty());

  const ModelSpec model = readOsim(result.files.at("adjusted_model.osim"), "adjusted_model.osim");
  EXPECT_EQ(model.muscles.at(0).kind, MuscleKind::kThelen2003);

  // The distributed result of inverse kinematics. Its marker placement also held joint angles,
  // which leaves an offset of some degrees between the two; the motion about it is the trial's own.
  const TimeSeries reference = readReference(model);
  const TimeSeries ours = toCoordinates(readTable(result.files.at("ik.mot"), "ik.mot"), model);
  for (const std::string side : {"_r", "_l"}) {
    for (const char* joint :
         {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle", "ankle_angle"}) {
      EXPECT_LT(calcSpread(reference, ours, joint + side), toRadians(4)) << joint << side;
    }
  }

  const TimeSeries& activations = result.tables.at("activations");
  const TimeSeries& forces = result.tables.at("forces");
  for (const MuscleSpec& muscle : model.muscles) {
    const auto activation = activations.values.col(activations.getColumn(muscle.name));
    EXPECT_GE(activation.minCoeff(), 0.01) << muscle.name;
    EXPECT_LE(activation.maxCoeff(), 1.0) << muscle.name;
    const auto force = forces.values.col(forces.getColumn(muscle.name));
    EXPECT_TRUE(force.allFinite()) << muscle.name;
    EXPECT_GE(force.minCoeff(), 0.0) << muscle.name;
    EXPECT_LE(force.maxCoeff(), 2 * muscle.max_isometric_force) << muscle.name;
  }
  // Running is carried by the calf: several body weights on each side.
  for (const char* soleus : {"soleus_r", "soleus_l"}) {
    EXPECT_GT(forces.values.col(forces.getColumn(soleus)).maxCoeff(), 2 * 65.9 * kGravity);
  }
}

}  // namespace
}  // namespace gaitmill
