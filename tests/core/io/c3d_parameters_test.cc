#include "core/io/c3d_parameters.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/c3d_reader.h"
#include "tests/support/c3d_writer.h"

namespace gaitmill {
namespace {

constexpr std::size_t kSection = 512;  // where the parameters begin
constexpr std::size_t kRecords = kSection + 4;

std::string makeTrial() {
  C3dWriter writer;
  writer.points = {{1, 2, 3, 0}};
  writer.analog = {{1, 2, -300, 4, 5, 6, 7}};
  writer.addPointGroup({"A"});
  writer.addAnalogGroup({"Fx", "Fy", "Fz", "Mx", "My", "Mz", "SOL"}, {"N"});
  writer.addPlate(2, {400, 600, 0, 0, 600, 0, 0, 0, 0, 400, 0, 0}, {0, 0, -40}, 6);
  writer.addReals("EVENT", "TIMES", {2, 1}, {0, 1});
  return writer.write();
}

/// Reads or refuses; anything else fails the test.
void expectReadOrRefused(const std::string& bytes) {
  try {
    readC3d(bytes, "a.c3d");
  } catch (const Error& error) {
    EXPECT_NE(error.code(), ErrorCode::kInternal) << error.what();
  }
}

C3dParameters parse(const std::string& bytes, std::vector<std::string>& warnings) {
  return {C3dBytes(bytes, C3dProcessor::kIntel), kRecords, bytes.size(), warnings};
}

TEST(C3dParameters, AreFoundWhateverTheirCaseAndBeforeTheirGroup) {
  C3dWriter writer;
  writer.addTexts("Point", "Labels", {"A", "BCD "});
  writer.addWords("POINT", "USED", {}, {65535});
  writer.addReals("POINT", "RATE", {}, {59.5});
  const std::string bytes = writer.write();
  std::vector<std::string> warnings;
  const C3dParameters parameters = parse(bytes, warnings);
  EXPECT_EQ(parameters.findTexts("POINT", "LABELS"), (std::vector<std::string>{"A", "BCD"}));
  EXPECT_EQ(parameters.findNumber("point", "used"), 65535);
  EXPECT_EQ(parameters.findSignedNumbers("POINT", "USED"), std::vector<double>{-1});
  EXPECT_EQ(parameters.findNumber("POINT", "RATE"), 59.5);
  EXPECT_EQ(parameters.findNumber("POINT", "SCALE"), std::nullopt);
  EXPECT_EQ(parameters.find("ANALOG", "RATE"), nullptr);
  EXPECT_TRUE(warnings.empty());
}

TEST(C3dParameters, ARecordThatClaimsMoreThanItHasIsLeftOut) {
  std::string bytes(1024, '\0');
  // Group 1 "G", then a parameter "P" of 255 x 255 reals in a record of 8 bytes.
  const std::string records(
      "\x01\xFFG\x03\x00\x00"
      "\x01\x01P\x08\x00\x04\x02\xFF\xFF\x00\x00\x00",
      18);
  bytes.replace(kRecords, records.size(), records);
  std::vector<std::string> warnings;
  const C3dParameters parameters = parse(bytes, warnings);
  EXPECT_EQ(parameters.find("G", "P"), nullptr);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(C3dParameters, OffsetsThatPointBackEndTheSection) {
  std::string bytes(1024, '\0');
  const std::string record("\x01\xFFG\x01\x00", 5);  // next record: inside this offset
  bytes.replace(kRecords, record.size(), record);
  std::vector<std::string> warnings;
  EXPECT_EQ(parse(bytes, warnings).find("G", "P"), nullptr);
}

TEST(HostileC3d, IsRefusedWithItsReason) {
  const std::string good = makeTrial();
  struct Case {
    const char* name;
    std::string bytes;
    ErrorCode code;
  };
  const auto changed = [&](std::size_t at, const std::string& with) {
    return std::string(good).replace(at, with.size(), with);
  };
  const std::vector<Case> cases = {
      {"nothing", "", ErrorCode::kFileEmpty},
      {"text", "PathFileType\t4\n", ErrorCode::kC3dHeader},
      {"header alone", good.substr(0, 512), ErrorCode::kC3dHeader},
      {"parameters beyond the end", changed(0, "\x1F"), ErrorCode::kC3dHeader},
      {"unknown processor", changed(kSection + 3, "\x57"), ErrorCode::kC3dHeader},
      {"data at block 0", changed(16, std::string(2, '\0')), ErrorCode::kC3dData},
      {"data beyond the end", changed(16, "\xFF\xFF"), ErrorCode::kC3dData},
  };
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.name);
    try {
      readC3d(bad.bytes, "a.c3d");
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), bad.code) << error.what();
    }
  }
}

TEST(HostileC3d, EveryCutIsReadOrRefused) {
  const std::string good = makeTrial();
  for (std::size_t size = 0; size < good.size(); size += 3) {
    expectReadOrRefused(good.substr(0, size));
  }
}

TEST(HostileC3d, EveryWordAtItsLimitsIsReadOrRefused) {
  const std::string good = makeTrial();
  for (const char value : {'\0', '\x01', '\x7F', '\x80', '\xFF'}) {
    for (std::size_t at = 0; at + 1 < good.size(); ++at) {
      std::string bytes = good;
      bytes[at] = value;
      bytes[at + 1] = value;
      expectReadOrRefused(bytes);
    }
  }
}

TEST(HostileC3d, RandomBytesBehindAGoodHeaderAreReadOrRefused) {
  const std::string good = makeTrial();
  std::mt19937 random(20140101);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bytes = good;
    for (int i = 0; i < 12; ++i) {
      bytes[2 + random() % (bytes.size() - 2)] = static_cast<char>(random());
    }
    expectReadOrRefused(bytes);
  }
}

}  // namespace
}  // namespace gaitmill
