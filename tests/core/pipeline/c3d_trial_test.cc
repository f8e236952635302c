// The sample trial once as TRC and MOT, once as one C3D file in a laboratory whose Z is up.

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// Ground (X forward, Y up, Z right) in a laboratory with X right, Y forward, Z up.
Eigen::Vector3d toLab(const Eigen::Vector3d& p) {
  return {p.z(), p.x(), p.y()};
}

constexpr double kMillimetres = 1000.0;

/// What a plate of type 2 measures whose surface is at the floor around the origin and whose
/// sensors lie 40 mm below: x of the plate is the laboratory's, y and z point the other way.
std::vector<double> measure(const ExternalForce& force, Eigen::Index row) {
  const auto toPlate = [](const Eigen::Vector3d& lab) {
    return Eigen::Vector3d(lab.x(), -lab.y(), -lab.z());
  };
  const Eigen::Vector3d f = toPlate(toLab(force.force.col(row)));
  const Eigen::Vector3d p = toPlate(toLab(force.point.col(row)));
  const Eigen::Vector3d t = toPlate(toLab(force.torque.col(row)));
  const Eigen::Vector3d m = (p - Eigen::Vector3d(0, 0, 0.04)).cross(f) + t;
  return {f.x(), f.y(), f.z(), kMillimetres * m.x(), kMillimetres * m.y(), kMillimetres * m.z()};
}

void addPlates(C3dWriter& writer) {
  const std::vector<double> corners = {
      2000, -3000, 0, -2000, -3000, 0, -2000, 3000, 0, 2000, 3000, 0};
  std::vector<double> both = corners;
  both.insert(both.end(), corners.begin(), corners.end());
  writer.addWords("FORCE_PLATFORM", "USED", {}, {2});
  writer.addWords("FORCE_PLATFORM", "TYPE", {2}, {2, 2});
  writer.addReals("FORCE_PLATFORM", "CORNERS", {3, 4, 2}, both);
  writer.addReals("FORCE_PLATFORM", "ORIGIN", {3, 2}, {0, 0, -40, 0, 0, -40});
  writer.addWords("FORCE_PLATFORM", "CHANNEL", {6, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
}

enum class Plates { kWithout, kWith };

InputFile writeSampleAsC3d(Plates plates) {
  const TrialInput sample = readSampleInput();
  const MarkerTrajectories markers = readTrc(sample.markers->bytes, "markers.trc").markers;
  const GroundReaction reaction =
      readGroundReaction(readTable(sample.ground_reaction->bytes, "grf.mot"));
  C3dWriter writer;
  writer.subframes = 2;
  for (int k = 0; k < markers.frameCount(); ++k) {
    writer.points.emplace_back();
    for (int i = 0; i < markers.markerCount(); ++i) {
      const Eigen::Vector3d p = kMillimetres * toLab(markers.position(k, i));
      writer.points.back().insert(writer.points.back().end(), {p.x(), p.y(), p.z(), 0.0});
    }
    for (Eigen::Index row = 2 * k; plates == Plates::kWith && row < 2 * k + 2; ++row) {
      std::vector<double> sampled = measure(reaction.forces[0], row);
      const std::vector<double> left = measure(reaction.forces[1], row);
      sampled.insert(sampled.end(), left.begin(), left.end());
      sampled.push_back(1e-3 * (1.0 + std::sin(0.1 * static_cast<double>(row))));
      writer.analog.push_back(sampled);
    }
  }
  writer.addPointGroup(markers.names);
  if (plates == Plates::kWith) {
    std::vector<std::string> labels(12, "Force");
    labels.push_back("SOL");
    writer.addAnalogGroup(
        labels, {"N", "N", "N", "Nmm", "Nmm", "Nmm", "N", "N", "N", "Nmm", "Nmm", "Nmm", "V"});
    addPlates(writer);
  }
  return {"sample.c3d", writer.write()};
}

PipelineResult run(const TrialInput& input, const std::string& settings) {
  return Pipeline("models").run(input, {"settings.json", settings}, {});
}

void expectNear(const TimeSeries& actual, const TimeSeries& expected, double tolerance) {
  ASSERT_EQ(actual.labels, expected.labels);
  ASSERT_EQ(actual.rowCount(), expected.rowCount());
  for (Eigen::Index row = 0; row < expected.values.rows(); ++row) {
    for (Eigen::Index i = 0; i < expected.values.cols(); ++i) {
      // What is not measured is so in both.
      ASSERT_EQ(std::isnan(actual.values(row, i)), std::isnan(expected.values(row, i)));
      if (!std::isnan(expected.values(row, i))) {
        EXPECT_NEAR(actual.values(row, i), expected.values(row, i), tol(tolerance))
            << expected.labels[static_cast<std::size_t>(i)];
      }
    }
  }
}

// The file has floats of micrometres and of 0.1 mN.
TEST(C3dTrial, GivesTheMotionAndForcesOfTheSameTrialInTables) {
  const TrialInput tables = readSampleInput();
  TrialInput c3d = readSampleInput();
  c3d.markers = writeSampleAsC3d(Plates::kWith);
  c3d.ground_reaction.reset();
  c3d.emg.reset();
  const PipelineResult expected = run(tables, R"({"stages": {"last": "id"}})");
  const PipelineResult actual = run(c3d, R"({"stages": {"last": "id"}, "trial": {"plates": [
    {"family": "plate_1", "body": "calcn_r"}, {"family": "plate_2", "body": "calcn_l"}]}})");
  expectNear(actual.tables.at("measured_markers"), expected.tables.at("measured_markers"), 1e-6);
  expectNear(actual.tables.at("ground_reactions"), expected.tables.at("ground_reactions"), 0.01);
  EXPECT_NE(actual.summary_json.find("\"emg\""), std::string::npos);
}

TEST(C3dTrial, WithoutForcesRunsUntilInverseKinematics) {
  TrialInput input = readSampleInput();
  input.markers = writeSampleAsC3d(Plates::kWithout);
  input.ground_reaction.reset();
  input.emg.reset();
  const PipelineResult result = run(input, R"({"stages": {"last": "ik"}})");
  EXPECT_EQ(result.files.count("ik.mot"), 1u);
  try {
    run(input, R"({"stages": {"last": "id"}})");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMissing) << error.what();
    EXPECT_NE(error.message().find("scale and ik can be run"), std::string::npos);
  }
}

}  // namespace
}  // namespace gaitmill
