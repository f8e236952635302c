// Property: whatever is done to a valid file, a reader returns or throws Error. It never crashes,
// never throws anything else and never allocates what a header merely claims.

#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

using Reader = std::function<void(const std::string&)>;

void readQuietly(const Reader& read, const std::string& bytes) {
  try {
    read(bytes);
  } catch (const Error&) {
    // Refusing is one of the two right answers.
  }
}

void truncateEverywhere(const Reader& read, const std::string& bytes, int cuts) {
  for (int i = 0; i <= cuts; ++i) {
    readQuietly(
        read,
        bytes.substr(0,
                     bytes.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(cuts)));
  }
}

void flipBytes(const Reader& read, const std::string& bytes, int rounds, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<std::size_t> place(0, bytes.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> count(1, 4);
  // Half of the changes use characters that mean something to a parser.
  const std::string meaning = "\t\n\r ,=<>/\"'&;-+.eE0123456789nNaA#:[]\xEF\xFF";
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = bytes;
    for (int n = count(generator); n > 0; --n) {
      const int value = byte(generator);
      damaged[place(generator)] = value < 128
                                      ? meaning[static_cast<std::size_t>(value) % meaning.size()]
                                      : static_cast<char>(value);
    }
    readQuietly(read, damaged);
  }
}

void removeOrRepeatPieces(const Reader& read, const std::string& bytes, int rounds, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<std::size_t> place(0, bytes.size() - 1);
  std::uniform_int_distribution<std::size_t> length(1, 200);
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = bytes;
    const std::size_t at = place(generator);
    const std::size_t n = length(generator);
    if (round % 2 == 0) {
      damaged.erase(at, n);
    } else {
      damaged.insert(place(generator), bytes.substr(at, n));
    }
    readQuietly(read, damaged);
  }
}

void damage(const Reader& read, const std::string& bytes) {
  ASSERT_NO_THROW(read(bytes)) << "the undamaged file is good";
  truncateEverywhere(read, bytes, 200);
  flipBytes(read, bytes, 400, 1);
  removeOrRepeatPieces(read, bytes, 200, 2);
}

void readTrcText(const std::string& text) {
  readTrc(text, "damaged.trc");
}
void readGrfText(const std::string& text) {
  readGroundReaction(readTable(text, "damaged.mot"));
}
void readTableText(const std::string& text) {
  readTable(text, "damaged.sto");
}
void readOsimText(const std::string& text) {
  readOsim(text, "damaged.osim");
}

std::string firstLines(const std::string& text, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string::npos; ++i) {
    end = text.find('\n', end) + 1;
  }
  return text.substr(0, end);
}

TEST(DamagedFiles, OwnModelDocument) {
  const std::string bytes = readFile("models/rajagopal2016/rajagopal2016.osim");
  flipBytes(readOsimText, bytes, 300, 3);
  removeOrRepeatPieces(readOsimText, bytes, 200, 4);
  truncateEverywhere(readOsimText, bytes, 100);
}

TEST(DamagedFiles, DeepNestingIsNoStackOverflow) {
  std::string nested = "<OpenSimDocument Version=\"40000\"><Model>";
  for (int i = 0; i < 200000; ++i) {
    nested += "<a>";
  }
  EXPECT_THROW(readOsimText(nested), Error);
  std::string functions;
  std::string closing;
  for (int i = 0; i < 5000; ++i) {
    functions += "<MultiplierFunction><function>";
    closing += "</function></MultiplierFunction>";
  }
  std::string document = readFile("models/rajagopal2016/rajagopal2016.osim");
  const std::string spline = "<SimmSpline name=\"function\">";
  document.insert(document.find(spline), "<function>" + functions + closing + "</function>");
  EXPECT_THROW(readOsimText(document), Error);
}

TEST(DamagedFiles, DocumentsOfTooManyObjectsAreRefused) {
  std::string bodies;
  for (int i = 0; i < 3000; ++i) {
    bodies += "<Body name=\"b" + std::to_string(i) + "\"><mass>1</mass></Body>";
  }
  const auto codeOf = [](const std::string& text) {
    try {
      readOsimText(text);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  const std::string head = "<OpenSimDocument Version=\"40000\"><Model>";
  EXPECT_EQ(codeOf(head + "<BodySet><objects>" + bodies +
                   "</objects></BodySet></Model></OpenSimDocument>"),
            ErrorCode::kModelUnsupported);
  EXPECT_EQ(codeOf(head + "<defaults>" + bodies + "</defaults></Model></OpenSimDocument>"),
            ErrorCode::kModelUnsupported);
  EXPECT_EQ(codeOf(head + std::string(17U << 20U, ' ') + "</Model></OpenSimDocument>"),
            ErrorCode::kFileTooLarge);
}

TEST(DamagedFiles, ClaimedSizesAreNotAllocated) {
  EXPECT_NO_THROW(
      readTableText("x\nnRows=999999999999\nnColumns=999999999999\nendheader\ntime a\n0 1\n"));
  EXPECT_NO_THROW(
      readTrcText("PathFileType\t4\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
                  "100\t100\t999999999999\t999999999999\tm\nFrame#\tTime\tA\n1\t0\t1\t2\t3\n"));
}

TEST(DamagedFiles, OldMacLineEndsAndByteOrderMarkAreRead) {
  EXPECT_EQ(readTable("\xEF\xBB\xBFtime\ta\r0\t1\r1\t2", "a.txt").table.rowCount(), 2);
}

class DamagedFilesShared : public SharedDataTest {};

TEST_F(DamagedFilesShared, MarkerFiles) {
  damage(readTrcText, firstLines(readFile(shared("data/walk/motion_capture_walk.trc")), 30));
  damage(readTrcText, firstLines(readFile(shared("data/run/paper_subject01/static_run.trc")), 20));
}

TEST_F(DamagedFilesShared, GroundReactions) {
  const std::string run = readFile(shared("data/run/paper_subject01/grf_run.mot"));
  damage(readGrfText, firstLines(run, 60));
}

TEST_F(DamagedFilesShared, Tables) {
  damage(readTableText, firstLines(readFile(shared("data/walk/moco/coordinates.mot")), 30));
  damage(readTableText,
         firstLines(readFile(shared("data/walk/example3DWalking/coordinates.sto")), 30));
  damage(readTableText,
         firstLines(readFile(shared("data/run/paper_subject01/emg_run_raw.csv")), 30));
}

TEST_F(DamagedFilesShared, OldModelDocument) {
  const std::string bytes = readFile(shared("data/models/Rajagopal2015.osim"));
  flipBytes(readOsimText, bytes, 100, 5);
  removeOrRepeatPieces(readOsimText, bytes, 100, 6);
  truncateEverywhere(readOsimText, bytes, 50);
}

}  // namespace
}  // namespace gaitmill
