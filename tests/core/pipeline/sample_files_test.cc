#include "core/pipeline/sample_files.h"

#include <string>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

ModelSpec readGeneric() {
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  return readOsim(readFile(path), path);
}

TEST(SampleFiles, AreThoseOfModelsSample) {
  const SampleFiles files = makeSampleFiles(readGeneric());
  for (const auto& [name, bytes] : files.recorded) {
    EXPECT_TRUE(bytes == readFile("models/sample/" + name))
        << "models/sample/" << name
        << " differs: gaitmill sample --out models/sample writes it anew";
  }
}

TEST(SampleFiles, AreReadBack) {
  const SampleFiles files = makeSampleFiles(readGeneric());
  const TrcFile markers = readTrc(files.recorded.at("markers.trc"), "markers.trc");
  EXPECT_TRUE(markers.warnings.empty());
  EXPECT_EQ(markers.markers.markerCount(), 42);
  EXPECT_EQ(markers.markers.frameCount(), 175);
  const GroundReaction reaction =
      readGroundReaction(readTable(files.recorded.at("grf.mot"), "grf.mot"), {});
  ASSERT_EQ(reaction.forces.size(), 2U);
  EXPECT_EQ(reaction.forces[0].body, "calcn_r");
  EXPECT_EQ(reaction.forces[1].body, "calcn_l");
  EXPECT_GT(reaction.forces[1].force.row(1).maxCoeff(), 700.0);
}

TEST(SampleSubject, IsStretchedAndHasThePersonsMass) {
  const ModelSpec generic = readGeneric();
  const ModelSpec subject = makeSampleSubject(generic);
  EXPECT_NEAR(subject.calcTotalMass(), 70.0, tol(1e-12));
  const auto heelOf = [](const ModelSpec& spec) {
    return spec.markers[static_cast<std::size_t>(spec.findMarker("RCAL"))].location;
  };
  EXPECT_LT((heelOf(subject) - 1.05 * heelOf(generic)).norm(), tol(1e-15));
}

}  // namespace
}  // namespace gaitmill
