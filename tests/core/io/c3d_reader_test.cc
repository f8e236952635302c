#include "core/io/c3d_reader.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kMillimetres = 1000.0;

/// Two markers over three frames, one of them not seen in the last.
C3dWriter makeTrial() {
  C3dWriter writer;
  writer.points = {{10, -20, 30.5, 0, 100, 200, 300, 257},
                   {11, -21, 31.5, 0, 101, 201, 301, 257},
                   {12, -22, 32.5, 0, 0, 0, 0, -1}};
  writer.addPointGroup({"RASI", "LASI"});
  return writer;
}

TEST(C3dReader, IsRecognisedByItsBytes) {
  EXPECT_TRUE(isC3d(makeTrial().write()));
  EXPECT_FALSE(isC3d("PathFileType\t4"));
  EXPECT_FALSE(isC3d("EP,time"));
  EXPECT_FALSE(isC3d("P"));
}

TEST(C3dReader, EveryProcessorAndStorageHoldsTheSameNumbers) {
  for (const C3dWriter::Processor processor :
       {C3dWriter::Processor::kIntel, C3dWriter::Processor::kDec, C3dWriter::Processor::kMips}) {
    for (const bool is_real : {true, false}) {
      C3dWriter writer;
      writer.processor = processor;
      writer.is_real = is_real;
      writer.point_scale = 0.5;
      writer.points = {{10, -20, 30.5, 0, 100, 200, 300, 257}, {11, -21, 31.5, 0, 0, 0, 0, -1}};
      writer.subframes = 2;
      writer.analog = {{-5}, {3}, {0}, {2047}};
      writer.addPointGroup({"RASI", "LASI"});
      writer.addAnalogGroup({"SOL"}, {"V"});
      const C3dFile file = readC3d(writer.write(), "a.c3d");
      SCOPED_TRACE(static_cast<int>(processor) * 10 + (is_real ? 1 : 0));
      EXPECT_EQ(file.warnings, std::vector<std::string>{});
      EXPECT_EQ(file.markers.names, (std::vector<std::string>{"RASI", "LASI"}));
      EXPECT_EQ(file.markers.position(0, 0) * kMillimetres, Eigen::Vector3d(10, -20, 30.5));
      EXPECT_EQ(file.markers.position(0, 1) * kMillimetres, Eigen::Vector3d(100, 200, 300));
      EXPECT_TRUE(file.markers.isMissing(1, 1));
      ASSERT_EQ(file.analog.rowCount(), 4);
      EXPECT_EQ(file.analog.values.col(0), Eigen::Vector4d(-5, 3, 0, 2047));
      EXPECT_EQ(file.analog.time[3], 3 / 200.0);
      EXPECT_EQ(file.analog_rate, 200);
    }
  }
}

TEST(C3dReader, UnitsBecomeMetresAndUnknownOnesAreSaid) {
  const std::map<std::string, double> kUnits = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}};
  for (const auto& [unit, metres] : kUnits) {
    C3dWriter writer;
    writer.points = {{2, 4, 8, 0}};
    writer.addTexts("POINT", "UNITS", {unit});
    writer.addPointGroup({"A"});
    const C3dFile file = readC3d(writer.write(), "a.c3d");
    EXPECT_EQ(file.units, unit);
    EXPECT_EQ(file.markers.position(0, 0), metres * Eigen::Vector3d(2, 4, 8));
  }
  C3dWriter writer;
  writer.points = {{2, 4, 8, 0}};
  writer.addTexts("POINT", "UNITS", {"furlong"});
  writer.addPointGroup({"A"});
  EXPECT_EQ(readC3d(writer.write(), "a.c3d").warnings.size(), 1u);
}

TEST(C3dReader, ExactZerosAreMissingWithAWarning) {
  C3dWriter writer;
  writer.points = {{0, 0, 0, 0}, {1, 2, 3, 0}};
  writer.addPointGroup({"A"});
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  EXPECT_TRUE(file.markers.isMissing(0, 0));
  EXPECT_FALSE(file.markers.isMissing(1, 0));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("'A'"), std::string::npos);
}

TEST(C3dReader, UnlabelledPointsModelOutputsAndRepeatedNamesAreLeftOut) {
  C3dWriter writer;
  writer.points = {std::vector<double>(24, 1.0)};
  writer.addPointGroup({"RASI", "*7", "LHipAngles", "RASI", ""});
  writer.addTexts("POINT", "ANGLES", {"LHipAngles", "RHipAngles"});
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  EXPECT_EQ(file.markers.names, std::vector<std::string>{"RASI"});
  ASSERT_EQ(file.warnings.size(), 3u);
  EXPECT_NE(file.warnings[1].find("3 points are unlabelled"), std::string::npos);
  EXPECT_NE(file.warnings[2].find("1 points are outputs"), std::string::npos);
}

TEST(C3dReader, APrefixOfOneSubjectGoesAndOfTwoStays) {
  C3dWriter one;
  one.points = {std::vector<double>(8, 1.0)};
  one.addPointGroup({"Ann:RASI", "Ann:LASI"});
  EXPECT_EQ(readC3d(one.write(), "a.c3d").markers.names,
            (std::vector<std::string>{"RASI", "LASI"}));
  C3dWriter two;
  two.points = {std::vector<double>(8, 1.0)};
  two.addPointGroup({"Ann:RASI", "Bob:RASI"});
  EXPECT_EQ(readC3d(two.write(), "a.c3d").markers.names,
            (std::vector<std::string>{"Ann:RASI", "Bob:RASI"}));
}

TEST(C3dReader, MoreThan255PointsAndChannelsKeepTheirNames) {
  C3dWriter writer;
  std::vector<std::string> points;
  std::vector<std::string> channels;
  writer.points.emplace_back();
  writer.analog.emplace_back();
  for (int i = 0; i < 600; ++i) {
    points.push_back("P" + std::to_string(i));
    channels.push_back("C" + std::to_string(i));
    for (const double value : {1.0 * i, 2.0, 3.0, 0.0}) {
      writer.points[0].push_back(value);
    }
    writer.analog[0].push_back(i);
  }
  writer.addPointGroup(points);
  writer.addAnalogGroup(channels, {"V"});
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  ASSERT_EQ(file.markers.names, points);
  EXPECT_EQ(file.markers.position(0, 599).x() * kMillimetres, 599);
  ASSERT_EQ(file.analog.labels, channels);
  EXPECT_EQ(file.analog.values(0, 599), 599);
}

TEST(C3dReader, SectionsMayBeMissing) {
  // Neither POINT nor ANALOG: the header alone says what is there.
  C3dWriter bare;
  bare.points = {{1, 2, 3, 0}};
  bare.analog = {{7}};
  bare.addTexts("MANUFACTURER", "COMPANY", {"nobody"});
  const C3dFile file = readC3d(bare.write(), "a.c3d");
  EXPECT_EQ(file.markers.markerCount(), 0);
  EXPECT_EQ(file.analog.labels, std::vector<std::string>{"channel_1"});
  EXPECT_EQ(file.analog.values(0, 0), 7);
  EXPECT_TRUE(file.plates.empty());
  // No points at all: a recording of EMG.
  C3dWriter emg;
  emg.analog = {{7}, {8}};
  emg.addAnalogGroup({"SOL"}, {"mV"});
  const C3dFile analog = readC3d(emg.write(), "a.c3d");
  EXPECT_EQ(analog.markers.markerCount(), 0);
  EXPECT_EQ(analog.analog.units, std::vector<std::string>{"V"});
  EXPECT_EQ(analog.analog.values(1, 0), 8e-3);
}

TEST(C3dReader, AnalogValuesAreScaledAndUnsignedWhereTheFileSays) {
  C3dWriter writer;
  writer.is_real = false;
  writer.analog = {{40000, 100}};
  writer.addTexts("ANALOG", "FORMAT", {"UNSIGNED"});
  writer.addReals("ANALOG", "SCALE", {2}, {0.5, -2.0});
  writer.addReals("ANALOG", "GEN_SCALE", {}, {0.1});
  writer.addWords("ANALOG", "OFFSET", {2}, {32768, 50});
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  EXPECT_NEAR(file.analog.values(0, 0), (40000 - 32768) * 0.05, tol(1e-4));  // 0.1 is a float
  EXPECT_NEAR(file.analog.values(0, 1), -10.0, tol(1e-6));
}

TEST(C3dReader, EventsMoveToTheAxisOfACutTrial) {
  C3dWriter writer = makeTrial();
  writer.first_frame = 201;
  writer.addWords("EVENT", "USED", {}, {2});
  writer.addTexts("EVENT", "LABELS", {"Foot Off", "Foot Strike"});
  writer.addTexts("EVENT", "CONTEXTS", {"Left", "Right"});
  writer.addReals("EVENT", "TIMES", {2, 2}, {0, 2.02, 0, 2.01});
  const C3dFile file = readC3d(writer.write(), "a.c3d");
  EXPECT_EQ(file.first_frame, 201);
  EXPECT_EQ(file.markers.time[0], 0.0);
  ASSERT_EQ(file.events.size(), 2u);
  EXPECT_EQ(file.events[0].label, "Foot Strike");
  EXPECT_EQ(file.events[0].context, "Right");
  EXPECT_NEAR(file.events[0].time, 0.01, tol(1e-6));
  EXPECT_NEAR(file.events[1].time, 0.02, tol(1e-6));
}

TEST(C3dReader, TextsOfOldYearsBecomeUtf8) {
  C3dWriter writer;
  writer.points = {{1, 2, 3, 0}};
  writer.addPointGroup(
      {"H\xFC"
       "fte"});
  EXPECT_EQ(readC3d(writer.write(), "a.c3d").markers.names,
            std::vector<std::string>{"H\xC3\xBC"
                                     "fte"});
}

class C3dReaderShared : public SharedDataTest {
 protected:
  C3dFile read(const std::string& name) const {
    const std::string path = shared("data/c3d/" + name);
    return readC3d(readFile(path), name);
  }
};

// The conversion prints five significant digits: half a unit of the fifth, and the rounding of the
// file's floats.
double halfLastDigit(double printed) {
  const double magnitude = std::floor(std::log10(std::max(std::abs(printed), 1e-3)));
  return 0.5 * std::pow(10.0, magnitude - 4.0) + 1e-4;
}

TEST_F(C3dReaderShared, MarkersAgreeWithTheReferenceConversion) {
  const C3dFile file = read("walking2.c3d");
  const std::string path = shared("data/c3d/expected/std_walking2_markers.trc");
  const MarkerTrajectories expected = readTrc(readFile(path), path).markers;
  ASSERT_EQ(file.markers.names, expected.names);
  EXPECT_EQ(file.markers.frameCount(), 1249);
  int seen = 0;
  for (int row = 0; row < expected.frameCount(); ++row) {
    const int frame = std::min(10 * row, 1248);  // every tenth and the last
    for (int i = 0; i < expected.markerCount(); ++i) {
      ASSERT_EQ(file.markers.isMissing(frame, i), expected.isMissing(row, i));
      if (!expected.isMissing(row, i)) {
        const Eigen::Vector3d printed = expected.position(row, i) * kMillimetres;
        const Eigen::Vector3d off = file.markers.position(frame, i) * kMillimetres - printed;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(std::abs(off[axis]), tol(halfLastDigit(printed[axis])));
        }
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 1000);
  // The same file decoded by hand, frame 630 (from 0) of the first two markers.
  const Eigen::Vector3d first(177.9450225830, 352.4907531738, 903.4423828125);
  const Eigen::Vector3d second(264.9566345215, 468.3961791992, 1727.6289062500);
  EXPECT_LT((file.markers.position(630, 0) * kMillimetres - first).norm(), tol(1e-4));
  EXPECT_LT((file.markers.position(630, 1) * kMillimetres - second).norm(), tol(1e-4));
}

TEST_F(C3dReaderShared, ForcesAgreeWithTheReferenceConversion) {
  const C3dFile file = read("walking2.c3d");
  const std::string path = shared("data/c3d/expected/std_cop_walking2_grfs.sto");
  const TimeSeries expected = readTable(readFile(path), path).table;
  ASSERT_EQ(file.ground_reaction.forces.size(), 2u);
  const auto rows = static_cast<int>(file.ground_reaction.time.size());
  ASSERT_EQ(rows, 9992);
  for (int row = 0; row < expected.rowCount(); ++row) {
    const Eigen::Index sample = std::min(100 * row, rows - 1);
    for (int plate = 0; plate < 2; ++plate) {
      const ExternalForce& force = file.ground_reaction.forces[static_cast<std::size_t>(plate)];
      const auto columns = expected.values.row(row).segment<9>(9 * plate).transpose();
      // Printed with eight decimals of N, mm and N.mm, from floats of seven digits.
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(force.force(axis, sample), columns[axis], tol(1e-7));
        const double point = columns[3 + axis];
        EXPECT_NEAR(force.point(axis, sample) * kMillimetres, point, tol(1e-6));
        const double moment = columns[6 + axis];
        EXPECT_NEAR(force.torque(axis, sample) * kMillimetres, moment, tol(1e-6));
      }
    }
  }
}

TEST_F(C3dReaderShared, MomentsAboutThePlateCentreAgreeWithTheReferenceConversion) {
  const C3dFile file = read("walking2.c3d");
  const std::string path = shared("data/c3d/expected/std_walking2_grfs.sto");
  const TimeSeries expected = readTable(readFile(path), path).table;
  for (int row = 0; row < expected.rowCount(); ++row) {
    const Eigen::Index sample = std::min(100 * row, 9991);
    for (std::size_t plate = 0; plate < 2; ++plate) {
      const ExternalForce& force = file.ground_reaction.forces[plate];
      const Eigen::VectorXd columns =
          expected.values.row(row).segment<9>(static_cast<Eigen::Index>(9 * plate)).transpose();
      const Eigen::Vector3d centre = file.plates[plate].corners.rowwise().mean();
      EXPECT_LT((centre * kMillimetres - columns.segment<3>(3)).norm(), tol(1e-5));
      const Eigen::Vector3d arm = force.point.col(sample) - centre;
      const Eigen::Vector3d moment =
          force.torque.col(sample) + arm.cross(Eigen::Vector3d(force.force.col(sample)));
      EXPECT_LT((moment * kMillimetres - columns.segment<3>(6)).norm(), tol(1e-5));
    }
  }
}

// All channels belong to plates here, so that the raw ones show only in the forces:
// lab force = (-Fy, -Fx, -Fz) for plate 1 (data README 7).
TEST_F(C3dReaderShared, RawChannelsAgreeWithTheReferenceConversion) {
  const C3dFile file = read("walking2.c3d");
  const std::string path = shared("data/c3d/expected/std_walking2_analog.sto");
  const TimeSeries expected = readTable(readFile(path), path).table;
  EXPECT_EQ(file.analog.columnCount(), 0);
  EXPECT_EQ(file.analog_channel_count, 12);
  EXPECT_EQ(file.analog_rate, 2000);
  for (int row = 0; row < expected.rowCount(); ++row) {
    const Eigen::Index sample = std::min(1000 * row, 9991);
    const Eigen::Vector3d force = file.ground_reaction.forces[0].force.col(sample);
    EXPECT_NEAR(force.x(), -expected.values(row, 1), tol(1e-5));
    EXPECT_NEAR(force.y(), -expected.values(row, 0), tol(1e-5));
    EXPECT_NEAR(force.z(), -expected.values(row, 2), tol(1e-5));
  }
}

TEST_F(C3dReaderShared, LoadedPlateHasItsCentreOfPressure) {
  const C3dFile file = read("walking2.c3d");
  const Eigen::Index sample = 624 * 8;
  const ExternalForce& force = file.ground_reaction.forces[1];
  EXPECT_NEAR(force.force(2, sample), 318.547, tol(5e-4));
  EXPECT_NEAR(force.point(0, sample) * kMillimetres, 62.63, tol(5e-3));
  EXPECT_NEAR(force.point(1, sample) * kMillimetres, 576.40, tol(5e-3));
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(file.up, "+Z");
}

TEST_F(C3dReaderShared, SixVariantsOfOneTrialHoldTheSame) {
  const C3dFile first = read("c3d_org_sample01/Eb015pi.c3d");
  EXPECT_EQ(first.markers.frameCount(), 450);
  EXPECT_EQ(first.markers.rate, 50);
  EXPECT_EQ(first.analog_channel_count, 16);
  EXPECT_EQ(first.analog_rate, 200);
  EXPECT_EQ(first.analog.labels, (std::vector<std::string>{"CH7", "CH8", "CH15", "CH16"}));
  const double half_quantum = 0.0833333 / 2;  // [mm] of the integer files
  EXPECT_LT(
      (first.markers.position(0, 0) * kMillimetres - Eigen::Vector3d(248.583, 226.833, 37.417))
          .cwiseAbs()
          .maxCoeff(),
      tol(5e-4));
  for (const char* const name : {"pr", "si", "sr", "vi", "vr"}) {
    SCOPED_TRACE(name);
    const C3dFile file = read(std::string("c3d_org_sample01/Eb015") + name + ".c3d");
    ASSERT_EQ(file.markers.names, first.markers.names);
    ASSERT_EQ(file.markers.frameCount(), 450);
    double furthest = 0;
    for (int frame = 0; frame < 450; ++frame) {
      for (int i = 0; i < file.markers.markerCount(); ++i) {
        ASSERT_EQ(file.markers.isMissing(frame, i), first.markers.isMissing(frame, i));
        if (!file.markers.isMissing(frame, i)) {
          const Eigen::Vector3d off =
              file.markers.position(frame, i) - first.markers.position(frame, i);
          furthest = std::max(furthest, off.cwiseAbs().maxCoeff());
        }
      }
    }
    EXPECT_LE(furthest * kMillimetres, tol(half_quantum * 1.001));
    ASSERT_EQ(file.ground_reaction.forces.size(), 2u);
    for (std::size_t plate = 0; plate < 2; ++plate) {
      const Eigen::Matrix3Xd off =
          file.ground_reaction.forces[plate].force - first.ground_reaction.forces[plate].force;
      EXPECT_LT(off.cwiseAbs().maxCoeff(), tol(1e-3));  // parameters of the DEC files are rounded
    }
    EXPECT_LT((file.analog.values - first.analog.values).cwiseAbs().maxCoeff(), tol(1e-3));
  }
}

// Plate 1 of the trial at its first sample: raw 2110, 2048, 2076, ... minus 2048, times the scale
// of the channel, times 0.5. The z axis points down within a degree.
TEST_F(C3dReaderShared, RawCountsBecomeNewtons) {
  const C3dFile file = read("c3d_org_sample01/Eb015pi.c3d");
  const double fx = (2110 - 2048) * -0.86 * 0.5;
  const double fz = (2076 - 2048) * -1.488 * 0.5;
  const Eigen::Vector3d force = file.ground_reaction.forces[0].force.col(0);
  EXPECT_NEAR(force.norm(), std::hypot(fx, fz), tol(1e-5));
  EXPECT_NEAR(force.z(), -fz, tol(0.3));
  EXPECT_NEAR(force.x(), fx, tol(0.3));
}

TEST_F(C3dReaderShared, SprintWithEightPlatesAndEmg) {
  const C3dFile file = read("JA1Gait35.c3d");
  EXPECT_EQ(file.markers.markerCount(), 51);  // 53 without *52 and *53
  EXPECT_EQ(file.markers.frameCount(), 324);
  EXPECT_EQ(file.first_frame, 833);
  ASSERT_EQ(file.ground_reaction.forces.size(), 8u);
  const ExternalForce& force = file.ground_reaction.forces[3];
  EXPECT_EQ(force.name, "plate_4");
  const Eigen::Index sample = 162 * 6;
  const Eigen::Vector3d expected(-86.375, 251.485, 2036.31);
  EXPECT_LT((force.force.col(sample) - expected).cwiseAbs().maxCoeff(), tol(5e-3));
  EXPECT_NEAR(force.point(0, sample) * kMillimetres, 178.27, tol(5e-3));
  EXPECT_NEAR(force.point(1, sample) * kMillimetres, -89.97, tol(5e-3));
  EXPECT_EQ(file.analog.columnCount(), 12);
  EXPECT_EQ(file.analog_rate, 1500);
  ASSERT_EQ(file.events.size(), 10u);
  EXPECT_EQ(file.events[0].label, "Foot Off");
  EXPECT_EQ(file.events[0].context, "Left");
  EXPECT_NEAR(file.events[0].time, 3.564 - 832 / 250.0, tol(1e-6));
}

TEST_F(C3dReaderShared, MarkersWithoutAnalogChannels) {
  const C3dFile file = read("cmu_dribble_shoot_basketball.c3d");
  EXPECT_EQ(file.markers.markerCount(), 41);
  EXPECT_EQ(file.markers.names[0], "LFHD");
  EXPECT_EQ(file.markers.rate, 120);
  EXPECT_EQ(file.markers.frameCount(), 494);
  EXPECT_EQ(file.first_frame, 187);
  EXPECT_TRUE(file.ground_reaction.forces.empty());
  EXPECT_EQ(file.analog.columnCount(), 0);
}

// One recording through a plate of type 2 and through its calibration matrix: the same loads within
// the few percent by which that plate's scales and matrix differ.
TEST_F(C3dReaderShared, CalibrationMatrixAndScalesAgree) {
  const C3dFile two = read("c3d_org_sample10/TYPE-2.C3D");
  const C3dFile four = read("c3d_org_sample10/TYPE-4.C3D");
  ASSERT_EQ(two.ground_reaction.forces.size(), 1u);
  ASSERT_EQ(four.ground_reaction.forces.size(), 1u);
  const Eigen::Matrix3Xd& f2 = two.ground_reaction.forces[0].force;
  const Eigen::Matrix3Xd& f4 = four.ground_reaction.forces[0].force;
  ASSERT_EQ(f2.cols(), 199 * 20);
  const double peak = f2.row(2).maxCoeff();
  EXPECT_GT(peak, 300);
  EXPECT_LT((f2.row(2) - f4.row(2)).cwiseAbs().maxCoeff(), tol(0.03 * peak));
  // By hand at the first sample: raw counts -2 in channel 2 and +1 in channel 5, factor -0.061103,
  // columns 2 and 5 of the matrix.
  const double s = -0.06110300123691559;
  const double fz = s * (-2 * -0.018999999389052390 + 1 * 0.0);
  EXPECT_NEAR(-fz, f4(2, 0), tol(1e-3));
}

}  // namespace
}  // namespace gaitmill
