#include "core/io/osim_frames.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/osim_reader.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

std::string makeFrame(const std::string& name, const std::string& parent, const std::string& rest) {
  return "<PhysicalOffsetFrame name=\"" + name + "\"><socket_parent>" + parent +
         "</socket_parent>" + rest + "</PhysicalOffsetFrame>";
}

// A frame on a frame: translation and orientation compose.
TEST(OsimFrames, NestedOffsetsCompose) {
  OsimPieces pieces;
  pieces.knee_frames =
      "<socket_parent_frame>outer</socket_parent_frame>"
      "<socket_child_frame>/bodyset/shank</socket_child_frame><frames>" +
      makeFrame("inner",
                "/bodyset/thigh",
                "<translation>0 -0.4 0</translation><orientation>0.3 -0.2 0.9</orientation>") +
      makeFrame("outer",
                "inner",
                "<translation>0.1 0.2 0.3</translation><orientation>-1.1 0.4 2</orientation>") +
      "</frames>";
  const FrameSpec frame = readOsim(makeOsim(pieces), "leg.osim").joints[1].parent;
  const Eigen::Matrix3d R_inner = makeRotation({0.3, -0.2, 0.9});
  const Eigen::Vector3d p = Eigen::Vector3d(0, -0.4, 0) + R_inner * Eigen::Vector3d(0.1, 0.2, 0.3);
  EXPECT_EQ(frame.body, "thigh");
  EXPECT_LT((frame.translation - p).norm(), tol(1e-15));
  EXPECT_LT((makeRotation(frame.orientation) - R_inner * makeRotation({-1.1, 0.4, 2})).norm(),
            tol(1e-14));
}

TEST(OsimFrames, SameFrameNameInTwoJointsMeansTwoFrames) {
  OsimPieces pieces;
  pieces.hip_frames =
      "<socket_parent_frame>/ground</socket_parent_frame>"
      "<socket_child_frame>thigh_offset</socket_child_frame><frames>" +
      makeFrame("thigh_offset", "/bodyset/thigh", "<translation>1 0 0</translation>") + "</frames>";
  pieces.knee_frames =
      "<socket_parent_frame>thigh_offset</socket_parent_frame>"
      "<socket_child_frame>/bodyset/shank</socket_child_frame><frames>" +
      makeFrame("thigh_offset", "/bodyset/thigh", "<translation>2 0 0</translation>") + "</frames>";
  const ModelSpec spec = readOsim(makeOsim(pieces), "leg.osim");
  EXPECT_EQ(spec.joints[0].child.translation[0], 1);
  EXPECT_EQ(spec.joints[1].parent.translation[0], 2);
}

TEST(OsimFrames, MarkerOnAnOffsetFrameMovesToItsBody) {
  OsimPieces pieces;
  pieces.knee_frames += "<frames>" +
                        makeFrame("f",
                                  "/bodyset/shank",
                                  "<translation>1 0 0</translation><orientation>0 0 " +
                                      std::to_string(kPi / 2) + "</orientation>") +
                        "</frames>";
  pieces.markers =
      "<Marker name=\"m\"><socket_parent_frame>/jointset/knee_joint/f</socket_parent_frame>"
      "<location>0.5 0 0</location></Marker>";
  const MarkerSpec marker = readOsim(makeOsim(pieces), "leg.osim").markers.at(0);
  EXPECT_EQ(marker.body, "shank");
  EXPECT_LT((marker.location - Eigen::Vector3d(1, 0.5, 0)).norm(), tol(1e-6)) << "pi of 6 digits";
}

TEST(OsimFrames, BetaSpellingsOfSocketsAreRead) {
  for (const char* const frames :
       {"<connectors><Connector_PhysicalFrame_ name=\"parent_frame\"><connectee_name>thigh"
        "</connectee_name></Connector_PhysicalFrame_><Connector_PhysicalFrame_ "
        "name=\"child_frame\">"
        "<connectee_name>shank</connectee_name></Connector_PhysicalFrame_></connectors>",
        "<connector_parent_frame_connectee_name>../../thigh</connector_parent_frame_connectee_name>"
        "<connector_child_frame_connectee_name>../../shank</connector_child_frame_connectee_name>",
        "<socket_parent_frame_connectee_name>thigh</socket_parent_frame_connectee_name>"
        "<socket_child_frame_connectee_name>shank</socket_child_frame_connectee_name>"}) {
    OsimPieces pieces;
    pieces.version = "30508";
    pieces.knee_frames = frames;
    const ModelSpec spec = readOsim(makeOsim(pieces), "leg.osim");
    EXPECT_EQ(spec.joints[1].parent.body, "thigh");
    EXPECT_EQ(spec.joints[1].child.body, "shank");
  }
}

}  // namespace
}  // namespace gaitmill
