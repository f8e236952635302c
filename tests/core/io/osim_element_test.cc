// Inherited defaults, property spellings and places (spec/model.md 1 and 2).

#include "core/io/osim_element.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"

namespace gaitmill {
namespace {

MuscleSpec readMuscleWith(const std::string& defaults, const std::string& properties) {
  OsimPieces pieces;
  pieces.defaults = defaults;
  pieces.forces = makeMuscleElement(properties);
  return readOsim(makeOsim(pieces), "leg.osim").muscles.at(0);
}

const char* const kPrototype =
    "<Millard2012EquilibriumMuscle name=\"default\"><max_isometric_force>546</max_isometric_force>"
    "<ActiveForceLengthCurve><minimum_value>0.05</minimum_value></ActiveForceLengthCurve>"
    "</Millard2012EquilibriumMuscle>";

TEST(OsimElement, OwnValueBeatsPrototypeBeatsClassDefault) {
  EXPECT_EQ(readMuscleWith("", "").max_isometric_force, 1000);
  EXPECT_EQ(readMuscleWith(kPrototype, "").max_isometric_force, 546);
  EXPECT_EQ(readMuscleWith(kPrototype, "<max_isometric_force>7</max_isometric_force>")
                .max_isometric_force,
            7);
}

TEST(OsimElement, NestedObjectStatedBySelfIgnoresTheOwnersPrototype) {
  EXPECT_EQ(readMuscleWith(kPrototype, "").curves.active_minimum_value, 0.05);
  EXPECT_EQ(readMuscleWith(kPrototype, "<ActiveForceLengthCurve />").curves.active_minimum_value,
            0.1)
      << "the class default of the curve, not the curve inside the muscle's prototype";
}

TEST(OsimElement, PrototypeHoldsForItsExactTypeOnly) {
  const std::string other =
      "<Thelen2003Muscle name=\"default\"><max_isometric_force>1</max_isometric_force>"
      "</Thelen2003Muscle>";
  EXPECT_EQ(readMuscleWith(other, "").max_isometric_force, 1000);
}

TEST(OsimElement, FunctionIsFoundInAllThreeSpellings) {
  const std::string spline = "<x>0 1</x><y>0 2</y>";
  for (const std::string& spelling :
       {"<function><SimmSpline>" + spline + "</SimmSpline></function>",
        "<SimmSpline name=\"function\">" + spline + "</SimmSpline>",
        "<SimmSpline>" + spline + "</SimmSpline>"}) {
    OsimPieces pieces;
    pieces.knee_transform = "<TransformAxis name=\"rotation1\"><coordinates>knee</coordinates>" +
                            spelling + "</TransformAxis>";
    const ModelSpec spec = readOsim(makeOsim(pieces), "leg.osim");
    EXPECT_EQ(spec.joints[1].axes[0].function.kind, FunctionSpec::Kind::kSimmSpline) << spelling;
  }
}

TEST(OsimElement, BlanksLeaveNamesOfOldDocuments) {
  OsimPieces pieces;
  pieces.version = "30000";
  pieces.markers = "<Marker name=\"R Heel\"><body>shank</body><location> 1 2 3</location></Marker>";
  const ModelSpec spec = readOsim(makeOsim(pieces), "leg.osim");
  EXPECT_EQ(spec.markers.at(0).name, "RHeel");
  EXPECT_EQ(spec.markers.at(0).location, Eigen::Vector3d(1, 2, 3));
}

TEST(OsimElement, PlaceIsThatOfTheBrokenToken) {
  const std::string text =
      "<OpenSimDocument Version=\"40000\">\n<Model><BodySet><objects>\n"
      "  <Body name=\"b\"><mass>1</mass>\r\n  <mass_center>0 1 x</mass_center></Body>";
  try {
    readOsim(text + "</objects></BodySet></Model></OpenSimDocument>", "b.osim");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where().line, 4);
    EXPECT_EQ(error.where().column, 20);
    EXPECT_EQ(error.where().field, "Body 'b'");
  }
}

}  // namespace
}  // namespace gaitmill
