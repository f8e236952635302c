// Broken inputs, each with the code it must give and the line and column it must name. In the
// texts,
// '@' marks that place and is removed before reading; a text without '@' is refused as a whole.

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"

namespace gaitmill {
namespace {

struct BadFile {
  std::string name;
  std::string text;
  ErrorCode code;
  bool names_column = true;  ///< else only the line
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the base text does not hold " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

void expectRefusal(const BadFile& bad, const std::function<void(const std::string&)>& read) {
  SCOPED_TRACE(bad.name);
  Where expected;
  std::string text = bad.text;
  const std::size_t mark = text.find('@');
  if (mark != std::string::npos) {
    expected.line = 1;
    expected.column = 1;
    for (std::size_t i = 0; i < mark; ++i) {
      expected.column = text[i] == '\n' ? 1 : expected.column + 1;
      expected.line += text[i] == '\n' ? 1 : 0;
    }
    text.erase(mark, 1);
  }
  try {
    read(text);
    ADD_FAILURE() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), bad.code) << error.what();
    EXPECT_EQ(error.where().file, "bad.file") << error.what();
    EXPECT_EQ(error.where().line, expected.line) << error.what();
    EXPECT_EQ(error.where().column, bad.names_column ? expected.column : 0) << error.what();
    EXPECT_FALSE(error.message().empty());
  }
}

const std::string kPointer = "@version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
const std::string kPage = "@<!DOCTYPE html>\n<html><body>404</body></html>\n";

// ------------------------------------------------------------------------------------------ TRC

const std::string kTrc =
    "PathFileType\t4\t(X/Y/Z)\ta.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
    "OrigNumFrames\n"
    "100\t100\t3\t2\tmm\t100\t1\t3\n"
    "Frame#\tTime\tA\t\t\tB\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
    "\n"
    "1\t0.00\t11\t12\t13\t14\t15\t16\n"
    "2\t0.01\t21\t22\t23\t24\t25\t26\n"
    "3\t0.02\t31\t32\t33\t34\t35\t36\n";

std::string trc(const std::string& from, const std::string& to) {
  return replaced(kTrc, from, to);
}

std::vector<BadFile> makeBadTrcFiles() {
  using Code = ErrorCode;
  const std::string head = kTrc.substr(0, kTrc.find("1\t0.00"));
  return {
      {"empty", "", Code::kFileEmpty},
      {"blank lines only", "\r\n\r\n \t\n", Code::kFileEmpty},
      {"LFS pointer", kPointer, Code::kFileNotTheData},
      {"web page", kPage, Code::kFileNotTheData},
      {"other first word", "@" + trc("PathFileType", "Path"), Code::kTrcHeader},
      {"a table", "@time\tA\n0\t1\n", Code::kTrcHeader},
      {"ends after line 1", "PathFileType\t4\n@", Code::kTrcHeader},
      {"keys begin otherwise", trc("DataRate\tCamera", "@Rate\tCamera"), Code::kTrcHeader},
      {"no Units key", replaced(trc("\tUnits", ""), "DataRate", "@DataRate"), Code::kTrcHeader},
      {"ends after the keys", kTrc.substr(0, kTrc.find("100\t")) + "@", Code::kTrcHeader},
      {"too few values", trc("mm\t100\t1\t3", "@mm"), Code::kTrcHeader},
      {"rate is a word", trc("100\t100", "@fast\t100"), Code::kTrcHeader},
      {"rate is negative", trc("100\t100", "@-100\t100"), Code::kTrcHeader},
      {"rate is not finite", trc("100\t100", "@inf\t100"), Code::kTrcHeader},
      {"frames is a word", trc("\t3\t2", "\t@all\t2"), Code::kTrcHeader},
      {"unknown units", trc("mm", "@inch"), Code::kTrcUnits},
      {"ends before the names", kTrc.substr(0, kTrc.find("Frame#")) + "@", Code::kTrcHeader},
      {"names without Frame#", trc("Frame#\tTime", "@Number\tTime"), Code::kTrcMarkerNames},
      {"names without Time", trc("Frame#\tTime", "@Frame#\tSeconds"), Code::kTrcMarkerNames},
      {"names apart by blanks",
       trc("Frame#\tTime\tA\t\t\tB\t\t", "@Frame# Time A B"),
       Code::kTrcMarkerNames},
      {"no names", trc("Frame#\tTime\tA\t\t\tB", "@Frame#\tTime\t\t\t\t"), Code::kTrcMarkerNames},
      {"unlabelled markers only",
       trc("Frame#\tTime\tA\t\t\tB", "@Frame#\tTime\t*1\t\t\t*2"),
       Code::kTrcMarkerNames},
      {"no rows", replaced(head, "\n\n", "\n@\n"), Code::kTrcNoRows},
      {"row too long", trc("25\t26", "25\t26\t@27"), Code::kTrcColumnCount},
      {"row too short", trc("24\t25\t26", "24\t@25"), Code::kTrcColumnCount},
      {"row is one cell", trc("2\t0.01\t21\t22\t23\t24\t25\t26", "@2"), Code::kTrcColumnCount},
      {"decimal comma", trc("22", "@2,2"), Code::kTrcNumber},
      {"letter in a number", trc("33", "@3O"), Code::kTrcNumber},
      {"hexadecimal", trc("16\n", "@0x10\n"), Code::kTrcNumber},
      {"number out of range", trc("16\n", "@1e999\n"), Code::kTrcNumber},
      {"frame number is broken", trc("2\t0.01", "@2.5\t0.01"), Code::kTrcNumber},
      {"time is a word", trc("2\t0.01", "2\t@later"), Code::kTrcNumber},
      {"time is missing", trc("2\t0.01", "2\t@nan"), Code::kTrcNumber},
      {"time stands still without a rate",
       replaced(trc("2\t0.01", "2\t0.00"), "100\t100", "@0\t100"),
       Code::kTrcTimeOrder},
  };
}

TEST(BadFiles, MarkerFilesAreRefusedWithCodeAndPlace) {
  for (const BadFile& bad : makeBadTrcFiles()) {
    expectRefusal(bad, [](const std::string& text) { readTrc(text, "bad.file"); });
  }
  EXPECT_EQ(readTrc(kTrc, "good").markers.frameCount(), 3) << "the base text itself is good";
}

// --------------------------------------------------------------------------------------- tables

const std::string kSto =
    "Coordinates\nversion=1\nnRows=3\nnColumns=3\ninDegrees=no\nendheader\n"
    "time\tq\tpelvis_tx\n0\t1\t2\n0.5\t3\t4\n1\t5\t6\n";

std::string sto(const std::string& from, const std::string& to) {
  return replaced(kSto, from, to);
}

std::vector<BadFile> makeBadTables() {
  using Code = ErrorCode;
  return {
      {"empty", "", Code::kFileEmpty},
      {"LFS pointer", kPointer, Code::kFileNotTheData},
      {"web page", kPage, Code::kFileNotTheData},
      {"row count is a word", sto("nRows", "@nRows=many\nnRows"), Code::kTableHeader},
      {"column count is negative", sto("nColumns=3", "@nColumns=-3"), Code::kTableHeader},
      {"absurd row count", sto("nRows=3", "@nRows=99999999999999999999"), Code::kTableHeader},
      {"angle unit undecided", sto("inDegrees=no", "@inDegrees=maybe"), Code::kTableHeader},
      {"table of vectors", sto("version=1", "@DataType=Vec3"), Code::kTableHeader},
      {"no endheader", "@" + sto("endheader\n", ""), Code::kTableLabels},
      {"time is not first", sto("time\tq", "@q\ttime"), Code::kTableLabels},
      {"label stands twice", sto("pelvis_tx", "@q"), Code::kTableDuplicateLabel},
      {"label is empty", sto("time\tq", "time\t@\tq"), Code::kTableLabels},
      {"no rows", replaced(kSto.substr(0, kSto.find("0\t1")), "time", "@time"), Code::kTableNoRows},
      {"row too short", sto("0.5\t3\t4", "0.5\t@3"), Code::kTableColumnCount},
      {"row too long", sto("0.5\t3\t4", "0.5\t3\t4\t@5"), Code::kTableColumnCount},
      {"cell is a word", sto("3\t4", "3\t@four"), Code::kTableNumber},
      {"two points in a number", sto("3\t4", "@3.1.4\t4"), Code::kTableNumber},
      {"two signs", sto("3\t4", "@--3\t4"), Code::kTableNumber},
      {"decimal comma", sto("3\t4", "@3,5\t4"), Code::kTableNumber},
      {"number out of range", sto("3\t4", "@1e400\t4"), Code::kTableNumber},
      {"time is missing", sto("0.5\t3", "@nan\t3"), Code::kTableNumber},
      {"time is infinite", sto("0.5\t3", "@inf\t3"), Code::kTableNumber},
      {"time goes back", sto("1\t5", "@0.25\t5"), Code::kTableTimeOrder},
      {"EMG apart by semicolons", "@time;SOL;GAS\n0;1;2\n", Code::kTableLabels},
      {"EMG without time", "@SOL,GAS\n1,2\n", Code::kTableLabels},
      {"EMG column without name", "time,SOL,@,GAS\n0,1,2,3\n", Code::kTableLabels},
      {"EMG channel twice", "time,SOL,@SOL\n0,1,2\n", Code::kTableDuplicateLabel},
      {"EMG row too short", "time\tSOL\tGAS\n0\t1\t2\n0.1\t@1\n", Code::kTableColumnCount},
      {"EMG row too long", "time,SOL\n0,1\n0.1,1,@2\n", Code::kTableColumnCount},
      {"EMG cell is a word", "time,SOL\n0,1\n0.1,@off\n", Code::kTableNumber},
      {"EMG row without time", "time,SOL\n0,1\n@,1\n", Code::kTableNumber},
      {"time in another unit", "@time [ms],SOL\n0,1\n", Code::kTableLabels},
      {"EMG labels only", "@time,SOL\n", Code::kTableNoRows},
  };
}

TEST(BadFiles, TablesAreRefusedWithCodeAndPlace) {
  for (const BadFile& bad : makeBadTables()) {
    expectRefusal(bad, [](const std::string& text) { readTable(text, "bad.file"); });
  }
  EXPECT_EQ(readTable(kSto, "good").table.rowCount(), 3) << "the base text itself is good";
}

// -------------------------------------------------------------------------------- ground reactions

const std::string kGrf =
    "time ground_force_r_vx ground_force_r_vy ground_force_r_vz ground_force_r_px "
    "ground_force_r_py ground_force_r_pz ground_torque_r_x ground_torque_r_y ground_torque_r_z\n"
    "0 1 800 3 0.1 0 0.2 0 5 0\n"
    "1 1 801 3 0.1 0 0.2 0 6 0\n"
    "2 1 1 3 0.1 0 0.2 0 6 0\n";

std::string grf(const std::string& from, const std::string& to) {
  return replaced(kGrf, from, to);
}

std::string markVx(const std::string& text) {
  return replaced(text, "ground_force_r_vx", "@ground_force_r_vx");
}

std::vector<BadFile> makeBadGroundReactions() {
  using Code = ErrorCode;
  std::string numbered = kGrf;
  for (std::size_t at = numbered.find("_r_"); at != std::string::npos; at = numbered.find("_r_")) {
    numbered.replace(at, 3, "_3_");
  }
  return {
      {"no force columns", "@time a b\n0 1 2\n", Code::kGrfColumns},
      {"force misses a component", "@" + grf("ground_force_r_vz", "else"), Code::kGrfColumns},
      {"no centre of pressure", markVx(grf("ground_force_r_px", "else")), Code::kGrfColumns},
      {"plates are numbered",
       replaced(numbered, "ground_force_3_vx", "@ground_force_3_vx"),
       Code::kGrfColumns},
      {"a force is missing", grf("1 1 801 3", "@1 1 nan 3"), Code::kGrfValue, false},
      {"a loaded point is missing", grf("1 1 801 3 0.1", "@1 1 801 3 nan"), Code::kGrfValue, false},
      {"a loaded torque is missing", grf("0 6 0\n2", "0 nan 0\n2"), Code::kGrfValue, false},
      {"forces on the floor",
       markVx(replaced(grf(" 800 ", " -800 "), " 801 ", " -801 ")),
       Code::kGrfUnits},
      {"forces beyond newtons", markVx(grf(" 800 ", " 800000 ")), Code::kGrfUnits},
      {"forces in body weights",
       "@" + replaced(grf(" 800 ", " 1.1 "), " 801 ", " 1.2 "),
       Code::kGrfUnits},
      {"points in millimetres",
       markVx(replaced(grf("800 3 0.1", "800 3 100"), "801 3 0.1", "801 3 100")),
       Code::kGrfUnits},
      {"torques in newton millimetres",
       markVx(replaced(grf("0 5 0", "0 5000 0"), "0 6 0", "0 6000 0")),
       Code::kGrfUnits},
  };
}

TEST(BadFiles, GroundReactionsAreRefusedWithCodeAndPlace) {
  for (BadFile bad : makeBadGroundReactions()) {
    if (bad.name == "a loaded torque is missing") {
      bad.text = replaced(bad.text, "1 1 801", "@1 1 801");
    }
    expectRefusal(bad,
                  [](const std::string& text) { readGroundReaction(readTable(text, "bad.file")); });
  }
  EXPECT_EQ(readGroundReaction(readTable(kGrf, "good")).forces.size(), 1u);
}

// ------------------------------------------------------------------------------- model documents

const std::string kOsim = R"(<?xml version="1.0" encoding="UTF-8" ?>
<OpenSimDocument Version="40000">
  <Model name="leg">
    <BodySet>
      <objects>
        <Body name="thigh">
          <mass>9.3</mass>
          <mass_center>0 -0.17 0</mass_center>
          <inertia>0.1 0.1 0.1 0 0 0</inertia>
          <WrapObjectSet>
            <objects>
              <WrapCylinder name="condyles">
                <quadrant>all</quadrant>
                <radius>0.025</radius>
              </WrapCylinder>
            </objects>
          </WrapObjectSet>
        </Body>
        <Body name="shank">
          <mass>3.7</mass>
        </Body>
      </objects>
    </BodySet>
    <JointSet>
      <objects>
        <PinJoint name="hip">
          <socket_parent_frame>/ground</socket_parent_frame>
          <socket_child_frame>/bodyset/thigh</socket_child_frame>
          <coordinates>
            <Coordinate name="hip_flexion">
              <range>-1 2</range>
              <locked>false</locked>
            </Coordinate>
          </coordinates>
        </PinJoint>
        <CustomJoint name="knee">
          <socket_parent_frame>thigh_offset</socket_parent_frame>
          <socket_child_frame>shank</socket_child_frame>
          <coordinates>
            <Coordinate name="knee_angle" />
          </coordinates>
          <frames>
            <PhysicalOffsetFrame name="thigh_offset">
              <socket_parent>/bodyset/thigh</socket_parent>
              <translation>0 -0.4 0</translation>
            </PhysicalOffsetFrame>
          </frames>
          <SpatialTransform>
            <TransformAxis name="rotation1">
              <coordinates>knee_angle</coordinates>
              <axis>0 0 1</axis>
              <LinearFunction name="function">
                <coefficients>1 0</coefficients>
              </LinearFunction>
            </TransformAxis>
            <TransformAxis name="translation1">
              <coordinates>knee_angle</coordinates>
              <SimmSpline name="function">
                <x>0 1 2</x>
                <y>0 0.1 0.3</y>
              </SimmSpline>
            </TransformAxis>
          </SpatialTransform>
        </CustomJoint>
      </objects>
    </JointSet>
    <ConstraintSet>
      <objects>
        <CoordinateCouplerConstraint name="coupler">
          <coupled_coordinates_function>
            <LinearFunction />
          </coupled_coordinates_function>
          <independent_coordinate_names>hip_flexion</independent_coordinate_names>
          <dependent_coordinate_name>knee_angle</dependent_coordinate_name>
        </CoordinateCouplerConstraint>
      </objects>
    </ConstraintSet>
    <ForceSet>
      <objects>
        <Millard2012EquilibriumMuscle name="gas">
          <GeometryPath>
            <PathPointSet>
              <objects>
                <PathPoint name="p1">
                  <socket_parent_frame>/bodyset/thigh</socket_parent_frame>
                </PathPoint>
                <PathPoint name="p2">
                  <socket_parent_frame>/bodyset/shank</socket_parent_frame>
                </PathPoint>
              </objects>
            </PathPointSet>
            <PathWrapSet>
              <objects>
                <PathWrap>
                  <wrap_object>condyles</wrap_object>
                  <range>-1 -1</range>
                </PathWrap>
              </objects>
            </PathWrapSet>
          </GeometryPath>
          <max_isometric_force>1000</max_isometric_force>
          <pennation_angle_at_optimal>0.2</pennation_angle_at_optimal>
          <FiberForceLengthCurve>
            <strain_at_one_norm_force>0.7</strain_at_one_norm_force>
          </FiberForceLengthCurve>
        </Millard2012EquilibriumMuscle>
        <CoordinateActuator name="reserve">
          <coordinate>hip_flexion</coordinate>
        </CoordinateActuator>
        <PointActuator name="residual">
          <body>thigh</body>
          <direction>1 0 0</direction>
        </PointActuator>
      </objects>
      <groups>
        <ObjectGroup name="calf">
          <members>gas</members>
        </ObjectGroup>
      </groups>
    </ForceSet>
    <MarkerSet>
      <objects>
        <Marker name="M1">
          <socket_parent_frame>/bodyset/shank</socket_parent_frame>
        </Marker>
        <Marker name="M2">
          <socket_parent_frame>/ground</socket_parent_frame>
        </Marker>
      </objects>
    </MarkerSet>
  </Model>
</OpenSimDocument>
)";

std::string osim(const std::string& from, const std::string& to) {
  return replaced(kOsim, from, to);
}

std::vector<BadFile> makeBadDocuments() {
  using Code = ErrorCode;
  return {
      {"empty", "", Code::kFileEmpty},
      {"LFS pointer", kPointer, Code::kFileNotTheData},
      {"web page", kPage, Code::kFileNotTheData},
      {"no XML at all", "name x\nendheader\n@", Code::kModelXml},
      {"tag never closed",
       osim("</Body>\n        <Body name=\"shank\">", "</@B>"),
       Code::kModelXml},
      {"other root", "@<Document Version=\"40000\"><Model/></Document>", Code::kModelElement},
      {"no version",
       osim("<OpenSimDocument Version=\"40000\"", "@<OpenSimDocument"),
       Code::kModelVersion},
      {"version too old",
       osim("<OpenSimDocument Version=\"40000\"", "@<OpenSimDocument Version=\"20301\""),
       Code::kModelVersion},
      {"version too new",
       osim("<OpenSimDocument Version=\"40000\"", "@<OpenSimDocument Version=\"50000\""),
       Code::kModelVersion},
      {"no model",
       "<?xml version=\"1.0\"?>\n@<OpenSimDocument Version=\"40000\"/>\n",
       Code::kModelElement},
      {"no bodies",
       "<OpenSimDocument Version=\"40000\">@<Model/></OpenSimDocument>",
       Code::kModelElement},
      {"not a rigid body",
       osim("<Body name=\"shank\">\n          <mass>3.7</mass>\n        </Body>",
            "@<Ghost name=\"shank\"/>"),
       Code::kModelUnsupported},
      {"body without name", osim("<Body name=\"shank\">", "@<Body>"), Code::kModelElement},
      {"second body of a name",
       osim("<Body name=\"shank\">", "@<Body name=\"thigh\">"),
       Code::kModelDuplicateName},
      {"body without mass",
       osim("<Body name=\"shank\">\n          <mass>3.7</mass>", "@<Body name=\"shank\">"),
       Code::kModelElement},
      {"negative mass", osim("<mass>9.3", "@<mass>-9.3"), Code::kModelValue},
      {"mass is a word", osim("<mass>9.3", "<mass>@heavy"), Code::kModelValue},
      {"mass is not a number", osim("<mass>9.3", "@<mass>NaN"), Code::kModelValue},
      {"two numbers for three",
       osim("<mass_center>0 -0.17 0", "@<mass_center>0 -0.17"),
       Code::kModelValue},
      {"second number broken",
       osim("<mass_center>0 -0.17 0", "<mass_center>0 @-0,17 0"),
       Code::kModelValue},
      {"five numbers for six", osim("<inertia>0.1 ", "@<inertia>"), Code::kModelValue},
      {"negative inertia",
       replaced(osim("<inertia>0.1", "<inertia>-0.1"),
                "<Body name=\"thigh\">",
                "@<Body name=\"thigh\">"),
       Code::kModelValue},
      {"torus",
       replaced(osim("<WrapCylinder", "@<WrapTorus"), "</WrapCylinder>", "</WrapTorus>"),
       Code::kModelUnsupported},
      {"unknown quadrant", osim("<quadrant>all", "@<quadrant>w"), Code::kModelValue},
      {"radius zero",
       replaced(osim("0.025", "0"), "<WrapCylinder", "@<WrapCylinder"),
       Code::kModelValue},
      {"ellipsoid joint",
       replaced(osim("<PinJoint", "@<EllipsoidJoint"), "</PinJoint>", "</EllipsoidJoint>"),
       Code::kModelUnsupported},
      {"second joint of a name",
       osim("<CustomJoint name=\"knee\"", "@<CustomJoint name=\"hip\""),
       Code::kModelDuplicateName},
      {"pin joint with two coordinates",
       replaced(osim("<Coordinate name=\"hip_flexion\">",
                     "<Coordinate name=\"extra\"/><Coordinate name=\"hip_flexion\">"),
                "<PinJoint",
                "@<PinJoint"),
       Code::kModelElement},
      {"unknown body in a joint",
       osim("<socket_child_frame>/bodyset/thigh", "@<socket_child_frame>/bodyset/thihg"),
       Code::kModelReference},
      {"unknown frame in a joint",
       osim("<socket_parent_frame>thigh_offset", "@<socket_parent_frame>offset"),
       Code::kModelReference},
      {"joint without frames",
       replaced(osim("<socket_parent_frame>/ground</socket_parent_frame>", ""),
                "<PinJoint",
                "@<PinJoint"),
       Code::kModelElement},
      {"frame without parent",
       replaced(osim("<socket_parent>/bodyset/thigh</socket_parent>", ""),
                "<PhysicalOffsetFrame",
                "@<PhysicalOffsetFrame"),
       Code::kModelElement},
      {"frames in a ring",
       osim("<socket_parent>/bodyset/thigh", "@<socket_parent>thigh_offset"),
       Code::kModelTopology},
      {"two joints for one body",
       replaced(osim("<socket_child_frame>shank", "<socket_child_frame>thigh"),
                "<CustomJoint",
                "@<CustomJoint"),
       Code::kModelTopology},
      {"ground as a child",
       replaced(osim("<socket_child_frame>shank", "<socket_child_frame>ground"),
                "<CustomJoint",
                "@<CustomJoint"),
       Code::kModelTopology},
      {"bodies in a ring",
       replaced(osim("<socket_parent_frame>/ground", "<socket_parent_frame>/bodyset/shank"),
                "<Body name=\"thigh\"",
                "@<Body name=\"thigh\""),
       Code::kModelTopology},
      {"coordinate in two joints",
       replaced(
           replaced(
               replaced(osim("\"knee_angle\"", "\"hip_flexion\""), ">knee_angle<", ">hip_flexion<"),
               ">knee_angle<",
               ">hip_flexion<"),
           "<CustomJoint",
           "@<CustomJoint"),
       Code::kModelDuplicateName},
      {"range reversed", osim("<range>-1 2", "@<range>2 -1"), Code::kModelValue},
      {"lock undecided", osim("<locked>false", "@<locked>perhaps"), Code::kModelValue},
      {"coordinate prescribed",
       osim("<Coordinate name=\"knee_angle\" />",
            "@<Coordinate name=\"knee_angle\"><prescribed>true</prescribed><prescribed_function>"
            "<Sine/></prescribed_function></Coordinate>"),
       Code::kModelUnsupported},
      {"axis of unknown name",
       osim("<TransformAxis name=\"rotation1\"", "@<TransformAxis name=\"rotation4\""),
       Code::kModelElement},
      {"axis stated twice",
       osim("<TransformAxis name=\"translation1\"", "@<TransformAxis name=\"rotation1\""),
       Code::kModelDuplicateName},
      {"axis without direction",
       replaced(osim("<axis>0 0 1", "<axis>0 0 0"), "<TransformAxis", "@<TransformAxis"),
       Code::kModelValue},
      {"axis of an unknown coordinate",
       osim("<coordinates>knee_angle", "@<coordinates>knee_angel"),
       Code::kModelReference},
      {"axis of two coordinates",
       osim("<coordinates>knee_angle", "@<coordinates>knee_angle hip_flexion"),
       Code::kModelUnsupported},
      {"function without coordinate",
       replaced(
           osim("<coordinates>knee_angle</coordinates>", ""), "<TransformAxis", "@<TransformAxis"),
       Code::kModelElement},
      {"coordinate that drives nothing",
       replaced(osim("<Coordinate name=\"knee_angle\" />",
                     "<Coordinate name=\"knee_angle\" /><Coordinate name=\"idle\" />"),
                "<CustomJoint",
                "@<CustomJoint"),
       Code::kModelElement},
      {"spline misses a value",
       replaced(osim("<y>0 0.1 0.3", "<y>0 0.1"), "<SimmSpline", "@<SimmSpline"),
       Code::kModelValue},
      {"spline goes back", osim("<x>0 1 2", "@<x>0 2 1"), Code::kModelValue},
      {"line with three coefficients",
       replaced(osim("<coefficients>1 0", "<coefficients>1 0 0"),
                "<LinearFunction name",
                "@<LinearFunction name"),
       Code::kModelUnsupported},
      {"unknown function",
       replaced(osim("<SimmSpline", "@<GCVSpline"), "</SimmSpline>", "</GCVSpline>"),
       Code::kModelUnsupported},
      {"coupler of an unknown coordinate",
       osim("<dependent_coordinate_name>knee", "@<dependent_coordinate_name>ankle"),
       Code::kModelReference},
      {"coupler of two coordinates",
       replaced(osim(">hip_flexion</indep", ">hip_flexion knee_angle</indep"),
                "<CoordinateCouplerConstraint",
                "@<CoordinateCouplerConstraint"),
       Code::kModelUnsupported},
      {"coupler without function",
       replaced(osim("<LinearFunction />", ""),
                "<CoordinateCouplerConstraint",
                "@<CoordinateCouplerConstraint"),
       Code::kModelElement},
      {"weld constraint",
       osim("<CoordinateCouplerConstraint name=\"coupler\">",
            "@<WeldConstraint name=\"w\"/>"
            "<CoordinateCouplerConstraint name=\"coupler\">"),
       Code::kModelUnsupported},
      {"unknown type of muscle",
       replaced(osim("<Millard2012EquilibriumMuscle", "@<Ghost1999Muscle"),
                "</Millard2012EquilibriumMuscle>",
                "</Ghost1999Muscle>"),
       Code::kModelUnsupported},
      {"Thelen muscle with less than its least activation",
       replaced(osim("<Millard2012EquilibriumMuscle name=\"gas\">",
                     "<Thelen2003Muscle name=\"gas\">@<minimum_activation>0.001"
                     "</minimum_activation>"),
                "</Millard2012EquilibriumMuscle>",
                "</Thelen2003Muscle>"),
       Code::kMuscleParameter},
      {"muscle without force",
       osim("<max_isometric_force>1000", "@<max_isometric_force>0"),
       Code::kMuscleParameter},
      {"pennation in degrees",
       osim("<pennation_angle_at_optimal>0.2", "@<pennation_angle_at_optimal>20"),
       Code::kMuscleParameter},
      {"fiber length infinite",
       osim("<max_isometric_force>1000",
            "@<optimal_fiber_length>Inf</optimal_fiber_length><max_isometric_force>1000"),
       Code::kMuscleParameter},
      {"one of three curve properties",
       replaced(osim("</strain_at_one_norm_force>",
                     "</strain_at_one_norm_force><curviness>0.5</curviness>"),
                "<FiberForceLengthCurve",
                "@<FiberForceLengthCurve"),
       Code::kMuscleParameter},
      {"path of one point",
       replaced(osim("<PathPoint name=\"p2\">\n                  "
                     "<socket_parent_frame>/bodyset/shank</socket_parent_frame>\n"
                     "                </PathPoint>",
                     ""),
                "<GeometryPath",
                "@<GeometryPath"),
       Code::kModelElement},
      {"unknown type of path point",
       replaced(osim("<PathPoint name=\"p1\"", "@<HoverPathPoint name=\"p1\""),
                "</PathPoint>",
                "</HoverPathPoint>"),
       Code::kModelUnsupported},
      {"path point conditional on an unknown coordinate",
       replaced(osim("<PathPoint name=\"p1\">",
                     "<ConditionalPathPoint name=\"p1\">@<socket_coordinate>hop"
                     "</socket_coordinate>"),
                "</PathPoint>",
                "</ConditionalPathPoint>"),
       Code::kModelReference},
      {"moving point of two coordinates",
       replaced(osim("<PathPoint name=\"p1\">",
                     "@<MovingPathPoint name=\"p1\"><x_coordinate>hip_flexion</x_coordinate>"),
                "</PathPoint>",
                "</MovingPathPoint>"),
       Code::kModelUnsupported},
      {"moving point with a function of three points in two",
       replaced(osim("<PathPoint name=\"p1\">",
                     "<MovingPathPoint name=\"p1\"><y_location>@<SimmSpline><x>0 1 2</x>"
                     "<y>1 2</y></SimmSpline></y_location>"),
                "</PathPoint>",
                "</MovingPathPoint>"),
       Code::kModelValue},
      {"path point on an unknown body",
       osim("<socket_parent_frame>/bodyset/thigh</", "@<socket_parent_frame>/bodyset/foot</"),
       Code::kModelReference},
      {"unknown wrap object",
       osim("<wrap_object>condyles", "@<wrap_object>condyle"),
       Code::kModelReference},
      {"muscle without path",
       replaced(replaced(osim("<GeometryPath>", "<Other>"), "</GeometryPath>", "</Other>"),
                "<Millard",
                "@<Millard"),
       Code::kModelElement},
      {"second force of a name",
       osim("<CoordinateActuator name=\"reserve\"", "@<CoordinateActuator name=\"gas\""),
       Code::kModelDuplicateName},
      {"actuator of an unknown coordinate",
       osim("<coordinate>hip", "@<coordinate>hop"),
       Code::kModelReference},
      {"actuator on an unknown body", osim("<body>thigh", "@<body>foot"), Code::kModelReference},
      {"actuator without direction",
       replaced(osim("<direction>1", "<direction>0"), "<PointActuator", "@<PointActuator"),
       Code::kModelValue},
      {"actuator on a point of ground",
       osim("<body>thigh</body>", "<body>thigh</body>@<point_is_global>true</point_is_global>"),
       Code::kModelUnsupported},
      {"ligament",
       osim("<CoordinateActuator name",
            "@<Ligament name=\"l\"/>"
            "<CoordinateActuator name"),
       Code::kModelUnsupported},
      {"group of an unknown force", osim("<members>gas", "@<members>sol"), Code::kModelReference},
      {"second marker of a name",
       osim("<Marker name=\"M2\"", "@<Marker name=\"M1\""),
       Code::kModelDuplicateName},
      {"marker on an unknown body",
       osim("<Marker name=\"M2\">\n          <socket_parent_frame>/ground",
            "<Marker name=\"M2\">\n          @<socket_parent_frame>/bodyset/head"),
       Code::kModelReference},
      {"marker on nothing",
       osim("<Marker name=\"M2\">\n          <socket_parent_frame>/ground</socket_parent_frame>",
            "@<Marker name=\"M2\">"),
       Code::kModelElement},
  };
}

TEST(BadFiles, DocumentsAreRefusedWithCodeAndPlace) {
  for (const BadFile& bad : makeBadDocuments()) {
    expectRefusal(bad, [](const std::string& text) { readOsim(text, "bad.file"); });
  }
  EXPECT_EQ(readOsim(kOsim, "good").muscles.size(), 1u) << "the base text itself is good";
}

TEST(BadFiles, TableHasAtLeastSixtyCases) {
  const std::size_t cases = makeBadTrcFiles().size() + makeBadTables().size() +
                            makeBadGroundReactions().size() + makeBadDocuments().size();
  EXPECT_GE(cases, 60u);
}

// ------------------------------------------------------------------------------- labels against
// models

TEST(BadFiles, CoordinateLabelsAreRefusedWithCodeAndPlace) {
  const ModelSpec model = readOsim(kOsim, "good");
  const std::string head = "Coordinates\nversion=1\nendheader\n";
  const std::vector<BadFile> table = {
      {"unknown coordinate",
       head + "time\tknee_angle\t@hip_flexoin\n0\t1\t2\n",
       ErrorCode::kTableUnknownLabel},
      {"a speed", head + "time\t@knee_angle_u\n0\t1\n", ErrorCode::kTableUnknownLabel},
      {"one coordinate twice",
       head + "time\tknee_angle\t@/jointset/knee/knee_angle/value\n0\t1\t2\n",
       ErrorCode::kTableDuplicateLabel}};
  for (const BadFile& bad : table) {
    expectRefusal(
        bad, [&](const std::string& text) { toCoordinates(readTable(text, "bad.file"), model); });
  }
}

}  // namespace
}  // namespace gaitmill
