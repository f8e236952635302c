#include "core/pipeline/archive.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/pipeline/checkpoint_fields.h"

namespace gaitmill {
namespace {

template <class Value>
Value passThrough(const Value& value) {
  ArchiveWriter writer;
  writer(value);
  Value read{};
  ArchiveReader reader(writer.bytes());
  reader(read);
  reader.finish();
  // The same bytes again: nothing was lost on the way.
  ArchiveWriter again;
  again(read);
  EXPECT_EQ(again.bytes(), writer.bytes());
  return read;
}

TEST(Archive, KeepsEveryBitOfANumber) {
  for (const double value : {0.1, -0.0, 1e300, std::numeric_limits<double>::denorm_min()}) {
    EXPECT_EQ(passThrough(value), value);
  }
  EXPECT_TRUE(std::signbit(passThrough(-0.0)));
  EXPECT_TRUE(std::isnan(passThrough(std::nan(""))));
  EXPECT_EQ(passThrough(-7), -7);
  EXPECT_EQ(passThrough(std::numeric_limits<std::uint64_t>::max()),
            std::numeric_limits<std::uint64_t>::max());
}

TEST(Archive, WritesNumbersLittleEndian) {
  ArchiveWriter writer;
  writer(std::uint64_t{0x0102030405060708}, 1.0);
  EXPECT_EQ(writer.bytes(),
            std::string("\x08\x07\x06\x05\x04\x03\x02\x01\0\0\0\0\0\0\xf0\x3f", 16));
}

TEST(Archive, KeepsAbsenceAndNesting) {
  EXPECT_EQ(passThrough(std::optional<double>()), std::nullopt);
  EXPECT_EQ(passThrough(std::optional<std::string>("x")), "x");
  const std::vector<std::vector<int>> nested = {{1, 2}, {}, {3}};
  EXPECT_EQ(passThrough(nested), nested);
}

TEST(Archive, KeepsAModel) {
  ModelSpec model;
  model.name = "pendulum";
  model.bodies.resize(2);
  model.bodies[1].inertia = {1, 2, 3, 4, 5, 6};
  model.joints.resize(1);
  model.joints[0].kind = JointSpec::Kind::kCustom;
  model.joints[0].axes[4].function.x = {1, 2};
  model.muscles.resize(1);
  model.muscles[0].tendon = TendonKind::kRigid;
  model.muscles[0].curves.tendon_curviness = 0.125;
  const ModelSpec read = passThrough(model);
  EXPECT_EQ(read.bodies[1].inertia, model.bodies[1].inertia);
  EXPECT_EQ(read.joints[0].axes[4].function.x, model.joints[0].axes[4].function.x);
  EXPECT_EQ(read.muscles[0].tendon, TendonKind::kRigid);
  EXPECT_EQ(read.muscles[0].curves.tendon_curviness, 0.125);
}

template <class Value>
ErrorCode findRefusal(const std::string& bytes) {
  Value value{};
  try {
    ArchiveReader reader(bytes);
    reader(value);
    reader.finish();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kUsage;
}

TEST(Archive, RefusesBytesThatEndEarlyOrLate) {
  ArchiveWriter writer;
  writer(std::vector<double>{1, 2, 3});
  for (std::size_t length = 0; length < writer.bytes().size(); ++length) {
    EXPECT_EQ(findRefusal<std::vector<double>>(writer.bytes().substr(0, length)),
              ErrorCode::kCheckpointUnusable)
        << length;
  }
  EXPECT_EQ(findRefusal<std::vector<double>>(writer.bytes() + "x"), ErrorCode::kCheckpointUnusable);
}

TEST(Archive, HostileLengthsDoNotAllocate) {
  const std::string huge(8, '\x7f');
  EXPECT_EQ(findRefusal<std::vector<ModelSpec>>(huge), ErrorCode::kCheckpointUnusable);
  EXPECT_EQ(findRefusal<std::string>(huge), ErrorCode::kCheckpointUnusable);
  EXPECT_EQ(findRefusal<RowMatrix>(huge + huge), ErrorCode::kCheckpointUnusable);
  // A product that wraps around to nothing.
  std::string wrapping(16, '\0');
  wrapping[4] = 1;
  wrapping[12] = 1;
  EXPECT_EQ(findRefusal<RowMatrix>(wrapping), ErrorCode::kCheckpointUnusable);
}

// CRC-64/XZ of the catalogue of parametrised CRC algorithms.
TEST(Checksum, IsThePublishedOne) {
  EXPECT_EQ(calcChecksum("123456789"), 0x995DC9BBDF1939FAU);
  EXPECT_EQ(calcChecksum("6789", calcChecksum("12345")), 0x995DC9BBDF1939FAU);
}

}  // namespace
}  // namespace gaitmill
