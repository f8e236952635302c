#include "core/io/anc_reader.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/emg_reader.h"
#include "core/io/files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Two channels at 1000 Hz, 12 bits.
const std::string kSmall =
    "File_Type:\tAnalog R/C ASCII\tGeneration#:\t2\n"
    "Board_Type:\tany\tPolarity:\tBipolar\n"
    "Trial_Name:\twalk\tTrial#:\t1\tDuration(Sec.):\t0.003\t#Channels:\t2\n"
    "BitDepth:\t12\tPreciseRate:\t1000.0\n"
    "\n\n"
    "Name\tF1Z\tSOL\t\n"
    "Rate\t1000\t1000\t\n"
    "Range\t5000\t2500\t\n"
    "0.000\t-4\t2048\t\n"
    "0.001\t0\t-1024\t\n"
    "0.002\t8\t\t\n";

// The text with one piece replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = kSmall;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Anc, CountsBecomeVolts) {
  const AncFile file = readAnc(kSmall, "a.anc");
  EXPECT_EQ(file.signals.labels, (std::vector<std::string>{"F1Z", "SOL"}));
  EXPECT_EQ(file.signals.units, (std::vector<std::string>{"V", "V"}));
  EXPECT_EQ(file.signals.time, (std::vector<double>{0, 0.001, 0.002}));
  EXPECT_EQ(file.rate, 1000.0);
  // Full scale 2 x 2.5 V over 4096 levels: half the levels are 2.5 V.
  EXPECT_EQ(file.signals.values(0, 1), 2.5);
  EXPECT_EQ(file.signals.values(1, 1), -1.25);
  EXPECT_NEAR(file.signals.values(0, 0), -4 * 10.0 / 4096, tol(1e-15));
  EXPECT_TRUE(std::isnan(file.signals.values(2, 1)));
  EXPECT_TRUE(file.warnings.empty());
}

TEST(Anc, AChannelOfAnotherRateIsDropped) {
  const AncFile file = readAnc(with("Rate\t1000\t1000", "Rate\t100\t1000"), "a.anc");
  EXPECT_EQ(file.signals.labels, std::vector<std::string>{"SOL"});
  EXPECT_EQ(file.signals.values(0, 0), 2.5);
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find("'F1Z'"), std::string::npos);
}

TEST(Anc, WhereTheStatedRateDiffersTheTimesCount) {
  const AncFile file = readAnc(with("PreciseRate:\t1000.0", "PreciseRate:\t960"), "a.anc");
  EXPECT_NEAR(file.rate, 1000.0, tol(1e-9));
  EXPECT_EQ(file.warnings.size(), 1U);
}

struct BadAnc {
  const char* what;
  std::string text;
  ErrorCode code;
  int line;
  int column;
};

TEST(Anc, FaultsNameLineAndColumn) {
  const BadAnc cases[] = {
      {"no first line", with("File_Type:", "Type:"), ErrorCode::kEmgHeader, 1, 1},
      {"bits", with("BitDepth:\t12", "BitDepth:\t64"), ErrorCode::kEmgHeader, 4, 11},
      {"no bits", with("BitDepth:", "Bits:"), ErrorCode::kEmgHeader, 7, 1},
      {"rate", with("PreciseRate:\t1000.0", "PreciseRate:\t-1"), ErrorCode::kEmgHeader, 4, 27},
      {"polarity", with("Bipolar", "Unipolar"), ErrorCode::kEmgHeader, 2, 27},
      {"no names", with("Name\t", "Nom\t"), ErrorCode::kEmgHeader, 12, 1},
      {"no ranges", with("Range\t", "Gain\t"), ErrorCode::kEmgHeader, 9, 1},
      {"a range too few", with("Range\t5000\t2500", "Range\t5000"), ErrorCode::kEmgHeader, 9, 7},
      {"a range of 0", with("Range\t5000\t2500", "Range\t0\t2500"), ErrorCode::kEmgHeader, 9, 7},
      {"twice", with("F1Z\tSOL", "SOL\tSOL"), ErrorCode::kTableDuplicateLabel, 7, 10},
      {"no label", with("F1Z\tSOL", "\tSOL"), ErrorCode::kTableLabels, 7, 6},
      {"a letter", with("-1024", "-1O24"), ErrorCode::kTableNumber, 11, 9},
      {"a count too few", with("0.001\t0\t", "0.001\t"), ErrorCode::kTableColumnCount, 11, 7},
      {"time", with("0.002\t8", "0.001\t8"), ErrorCode::kTableTimeOrder, 12, 1},
      {"no rows", kSmall.substr(0, kSmall.find("0.000")), ErrorCode::kTableNoRows, 9, 1},
      {"nothing", "", ErrorCode::kFileEmpty, 0, 0}};
  for (const BadAnc& bad : cases) {
    try {
      readAnc(bad.text, "a.anc");
      ADD_FAILURE() << bad.what << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(codeName(error.code()), codeName(bad.code)) << bad.what << ": " << error.what();
      EXPECT_EQ(error.where().file, "a.anc") << bad.what;
      EXPECT_EQ(error.where().line, bad.line) << bad.what << ": " << error.what();
      EXPECT_EQ(error.where().column, bad.column) << bad.what << ": " << error.what();
    }
  }
}

TEST(Emg, ChannelsOfForcePlatesAreLeftOut) {
  const EmgFile file = readEmg(kSmall, "a.anc");
  EXPECT_EQ(file.format, "anc");
  EXPECT_EQ(file.signals.labels, std::vector<std::string>{"SOL"});
  EXPECT_EQ(file.force_channels, std::vector<std::string>{"F1Z"});
  EXPECT_EQ(file.signals.values(1, 0), -1.25);
}

TEST(Emg, TablesComeWithTabsCommasAndHeaders) {
  const std::string header = "emg\nversion=1\nnRows=2\nnColumns=3\nendheader\n";
  const std::string rows = "time\tSOL\tFx1\tM2z\n0\t1\t7\t7\n0.5\t2\t7\t7\n";
  for (const std::string& text : {rows, header + rows}) {
    const EmgFile file = readEmg(text, "emg.txt");
    EXPECT_EQ(file.format, "table");
    EXPECT_EQ(file.signals.labels, std::vector<std::string>{"SOL"});
    EXPECT_EQ(file.signals.units, std::vector<std::string>{""});
    EXPECT_EQ(file.signals.values(1, 0), 2);
    EXPECT_EQ(file.force_channels.size(), 2U);
  }
  const EmgFile commas = readEmg("time,SOL [mV]\n0,1\n0.5,2\n", "emg.csv");
  EXPECT_EQ(commas.signals.units, std::vector<std::string>{"mV"});
}

TEST(Emg, AFileOfForcesOnlyIsRefused) {
  try {
    readEmg("time\tF1X\n0\t1\n1\t2\n", "emg.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEmgChannels);
  }
}

TEST(Emg, ATableAsWideAsNoRecordingIsRefused) {
  std::string labels = "time";
  std::string row = "0";
  for (int i = 0; i < 257; ++i) {
    labels += ",c" + std::to_string(i);
    row += ",1";
  }
  try {
    readEmg(labels + "\n" + row + "\n", "emg.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEmgChannels);
  }
}

using PublishedEmg = SharedDataTest;

TEST_F(PublishedEmg, TheAnalogFileOfTheWalkingTrial) {
  const std::string path = shared("data/walk/emg_walk_raw.anc");
  const EmgFile file = readEmg(readFile(path), path);
  EXPECT_EQ(
      file.signals.labels,
      (std::vector<std::string>{"SOL", "GAS", "TA", "MH", "BF", "VL", "VM", "RF", "GMAX", "GMED"}));
  EXPECT_EQ(file.force_channels.size(), 18U);
  EXPECT_EQ(file.signals.rowCount(), 4780);
  EXPECT_EQ(file.signals.time.back(), 2.3895);
  // First counts of SOL and MH, full scales 2500 and 1000 mV.
  EXPECT_NEAR(file.signals.values(0, 0), -197 * 5.0 / 65536, tol(1e-15));
  EXPECT_NEAR(file.signals.values(0, 3), 463 * 2.0 / 65536, tol(1e-15));
  EXPECT_TRUE(file.warnings.empty());
}

}  // namespace
}  // namespace gaitmill
