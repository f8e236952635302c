#include "core/io/table_reader.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/text_cells.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

double valueAt(const TableFile& file, int row, const std::string& label) {
  return file.table.values(row, file.table.getColumn(label));
}

TEST(TableReader, SimmHeaderWithPaddedLabelsAndTrailingTabs) {
  const TableFile file = readTable(
      "name a.mot\t\t\r\ndatacolumns 3\t\t\r\ndatarows 2\t\t\r\nrange 0 1\t\t\r\nendheader\t\t\r\n"
      "                time\t             knee_r\t   hip_r\r\n0.0\t1.5\t2.5\r\n1.0\t3.5\tnan\r\n",
      "a.mot");
  EXPECT_EQ(file.table.name, "a.mot");
  EXPECT_EQ(file.table.labels, (std::vector<std::string>{"knee_r", "hip_r"}));
  EXPECT_EQ(file.table.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(valueAt(file, 1, "knee_r"), 3.5);
  EXPECT_TRUE(std::isnan(valueAt(file, 1, "hip_r")));
  EXPECT_TRUE(file.in_degrees) << "a .mot without statement is taken as degrees";
  EXPECT_FALSE(file.degrees_stated);
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(file.label_line, 6);
  EXPECT_EQ(file.label_columns[0], 35);
}

TEST(TableReader, VersionThreeHeaderWithoutCounts) {
  const TableFile file = readTable(
      "DataType=double\nversion=3\nOpenSimVersion=4.5\nendheader\ntime\ta\n0\t1e-3\n0.5 \t +2\n",
      "a.sto");
  EXPECT_EQ(file.table.rowCount(), 2);
  EXPECT_EQ(valueAt(file, 1, "a"), 2);
  EXPECT_FALSE(file.in_degrees);
}

TEST(TableReader, WrongCountsAreWarnings) {
  const TableFile file =
      readTable("t\nnRows = 60\nnColumns=5\ninDegrees=yes\nendheader \ntime\ta\n0\t1\n", "a.sto");
  EXPECT_EQ(file.warnings.size(), 2u);
  EXPECT_TRUE(file.in_degrees);
  EXPECT_TRUE(file.degrees_stated);
}

TEST(TableReader, AngleUnitInTextCountsForVersionlessFilesOnly) {
  const std::string rest = "\nendheader\ntime\ta\n0\t1\n";
  EXPECT_FALSE(readTable("name x\nAngles are in radians." + rest, "a.mot").in_degrees);
  EXPECT_TRUE(readTable("name x\nAngles are in degrees." + rest, "a.sto").in_degrees);
  EXPECT_FALSE(readTable("x\nversion=1\nAngles are in degrees." + rest, "a.sto").in_degrees);
  EXPECT_TRUE(readTable("name x\nangles may be in degrees (yes) or radians (no)" + rest, "a.mot")
                  .in_degrees);
}

TEST(TableReader, CommaTableMayMissValuesAndStateUnits) {
  const TableFile file =
      readTable("time [s],\"knee_angle_r [rad]\",soleus_r [1]\n0,1,\n0.5,,3\n", "a.csv");
  EXPECT_EQ(file.table.labels, (std::vector<std::string>{"knee_angle_r", "soleus_r"}));
  EXPECT_EQ(file.table.units, (std::vector<std::string>{"rad", ""}));
  EXPECT_TRUE(std::isnan(valueAt(file, 0, "soleus_r")));
  EXPECT_EQ(valueAt(file, 1, "soleus_r"), 3);
}

TEST(TableReader, RowRepeatingATimeIsDroppedWithAWarning) {
  const TableFile file = readTable("time a\n0 1\n0 2\n1 3\n", "a.txt");
  EXPECT_EQ(file.table.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(valueAt(file, 1, "a"), 3);
  EXPECT_EQ(file.warnings.size(), 1u);
}

TEST(TableReader, LabelLineOfSeparatorsOnlyIsRefused) {
  for (const char* const line : {",\n", ",,,\r0,1,2,3\n"}) {
    try {
      readTable(line, "a.csv");
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kTableLabels) << error.what();
    }
  }
}

TEST(TableReader, EndlessLabelLineIsRefused) {
  std::string text = "time";
  for (std::size_t i = 0; i < 10 * kMaximumCells; ++i) {
    text += "," + std::to_string(i);
  }
  EXPECT_THROW(readTable(text + "\n0\n", "a.csv"), Error);
}

TEST(TableReader, SeveralFaultsAreReportedTogether) {
  try {
    readTable("time a\n0 x\n1 2 3\n2 y\n", "a.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTableNumber);
    EXPECT_EQ(error.where().line, 2);
    EXPECT_EQ(error.where().column, 3);
    EXPECT_EQ(error.context().size(), 2u);
  }
}

TEST(TableReader, ColumnNamesOfAllGenerations) {
  const ColumnName value = parseColumnName("/jointset/walker_knee_r/knee_angle_r/value");
  EXPECT_EQ(value.kind, ColumnName::Kind::kValue);
  EXPECT_EQ(value.name, "knee_angle_r");
  EXPECT_EQ(parseColumnName("back/lumbar_bending/speed").name, "lumbar_bending");
  EXPECT_EQ(parseColumnName("hip_flexion_l_u").kind, ColumnName::Kind::kSpeed);
  EXPECT_EQ(parseColumnName("soleus_r.activation").name, "soleus_r");
  EXPECT_EQ(parseColumnName("/forceset/soleus_r/fiber_length").kind,
            ColumnName::Kind::kFiberLength);
  EXPECT_EQ(parseColumnName("pelvis_tx").kind, ColumnName::Kind::kPlain);
}

class TableReaderShared : public SharedDataTest {
 protected:
  TableFile read(const std::string& relative) const {
    return readTable(readFile(shared(relative)), relative);
  }
  ModelSpec readModel() const {
    const std::string path = "data/models/Rajagopal2016.osim";
    return readOsim(readFile(shared(path)), path);
  }
};

// data/README.md 5 and 6: rows and time ranges.
TEST_F(TableReaderShared, EveryTableOfTheTrialsIsRead) {
  struct Expectation {
    const char* file;
    int rows;
    int columns;
    double first;
    double last;
    std::size_t warnings;
  };
  const Expectation expectations[] = {
      {"data/walk/grf_walk.mot", 4778, 18, 0, 2.3885, 0},
      {"data/walk/example3DWalking/grf_walk.mot", 4778, 18, 0, 2.3885, 0},
      {"data/walk/moco/grf_walk_smoothed.mot", 4778, 18, 0, 2.3885, 0},
      {"data/walk/moco/coordinates.mot", 238, 39, 0, 2.37, 0},
      {"data/walk/example3DWalking/coordinates.sto", 1350, 31, 0.45, 1.799, 1},
      {"data/walk/example3DWalking/electromyography.sto", 4780, 10, 0, 2.3895, 0},
      {"data/walk/example3DWalking/id_walk.sto", 1350, 31, 0.45, 1.799, 0},
      {"data/walk/emg_walk.txt", 4780, 10, 0, 2.3895, 0},
      {"data/run/paper_subject01/grf_run.mot", 5091, 18, 0.23, 5.32, 0},
      {"data/run/paper_subject01/emg_run.txt", 5590, 11, 0, 5589.0 / 960.0, 0},
      {"data/run/hamner2010/subject02_running_grf.mot", 601, 41, 0, 10, 1},
      {"data/run/hamner2010/reference/subject02_running_ik.mot", 599, 0, 0, 598.0 / 60.0, 0},
      {"data/run/hamner2013_subject04/run400/grf.mot", 4182, 18, 0.6455, 2.736, 1},
      {"data/c3d/expected/std_cop_walking2_grfs.sto", 101, 18, 0, 4.9955, 0},
      {"data/c3d/expected/std_walking2_analog.sto", 0, 12, 0, 0, 0},
      {"reference/walk/ik/ik.mot", 238, 39, 0, 2.37, 0},
      {"reference/walk/rra/pass1/kinematics_q.sto", 1370, 39, 0.45, 1.799, 1},
      {"reference/walk/id/inverse_dynamics.sto", 1371, 39, 0.45, 1.799, 0},
  };
  for (const Expectation& expected : expectations) {
    SCOPED_TRACE(expected.file);
    const TableFile file = read(expected.file);
    if (expected.rows > 0) {
      EXPECT_EQ(file.table.rowCount(), expected.rows);
      EXPECT_NEAR(file.table.time.back(), expected.last, tol(1e-6));
      EXPECT_EQ(file.warnings.size(), expected.warnings)
          << (file.warnings.empty() ? "" : file.warnings[0]);
    }
    if (expected.columns > 0) {
      EXPECT_EQ(file.table.columnCount(), expected.columns);
    }
    EXPECT_NEAR(file.table.time.front(), expected.first, tol(1e-12));
  }
}

// spec/formats.md 2.2: a file in degrees keeps the patella in radians.
TEST_F(TableReaderShared, CoupledCoordinatesStayInRadians) {
  const TableFile file = read("data/walk/moco/coordinates.mot");
  EXPECT_TRUE(file.in_degrees);
  const TimeSeries q = toCoordinates(file, readModel());
  EXPECT_EQ(q.columnCount(), 39);
  const double knee = q.values(0, q.getColumn("knee_angle_r"));
  EXPECT_NEAR(knee, toRadians(70.78551579), tol(1e-14));
  EXPECT_NEAR(q.values(0, q.getColumn("knee_angle_r_beta")), knee, tol(1e-7));
  EXPECT_EQ(q.values(0, q.getColumn("pelvis_tx")), -0.57712974);
  EXPECT_EQ(q.units[static_cast<std::size_t>(q.getColumn("pelvis_tx"))], "m");
  EXPECT_EQ(q.units[static_cast<std::size_t>(q.getColumn("knee_angle_r_beta"))], "rad");
}

TEST_F(TableReaderShared, StatePathsBecomePlainNames) {
  const TimeSeries q =
      toCoordinates(read("data/walk/example3DWalking/coordinates.sto"), readModel());
  EXPECT_EQ(q.columnCount(), 31);
  EXPECT_EQ(q.values(0, q.getColumn("pelvis_list")), -0.04572838422421265);
}

TEST_F(TableReaderShared, LabelsThatAreNoCoordinatesAreAnErrorUnlessAsked) {
  const TableFile file = read("data/walk/example3DWalking/id_walk.sto");
  try {
    toCoordinates(file, readModel());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTableUnknownLabel);
    EXPECT_EQ(error.where().line, 7);
    EXPECT_EQ(error.where().column, 6);
    EXPECT_EQ(error.where().field, "pelvis_tilt_moment");
  }
  std::vector<std::string> ignored;
  EXPECT_THROW(toCoordinates(file, readModel(), &ignored), Error) << "nothing is left";
  EXPECT_EQ(ignored.size(), 31u);
}

}  // namespace
}  // namespace gaitmill
