#include "core/io/osim_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/core/io/osim_samples.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

int countMeshes(const ModelSpec& spec) {
  std::size_t count = 0;
  for (const BodySpec& body : spec.bodies) {
    count += body.meshes.size();
  }
  return static_cast<int>(count);
}

// What would change the results is told at once, with the line of each.
TEST(OsimReader, AllThatCannotBeSimulatedIsNamedAtOnce) {
  OsimPieces pieces;
  pieces.thigh =
      "\n<WrapObjectSet><objects>\n<WrapTorus name=\"hole\" /></objects></WrapObjectSet>";
  pieces.constraints = "\n<WeldConstraint name=\"glue\" />";
  pieces.forces = "\n<Ligament name=\"acl\" />\n<Blankevoort1991Ligament name=\"mcl\" />" +
                  makeMuscleElement("") +
                  "\n<HuntCrossleyForce name=\"floor\" />"
                  "<Ligament name=\"off\"><appliesForce>false</appliesForce></Ligament>";
  std::vector<std::string> warnings;
  try {
    readOsim(makeOsim(pieces), "knee.osim", &warnings);
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelUnsupported);
    EXPECT_EQ(error.where().line, 3);
    const std::string& message = error.message();
    EXPECT_EQ(message.rfind("4 parts of the model cannot be simulated", 0), 0u) << message;
    for (const char* line : {"\nline 3: WrapTorus 'hole': ",
                             "\nline 4: WeldConstraint 'glue': ",
                             "\nline 5: Ligament 'acl': ",
                             "\nline 6: Blankevoort1991Ligament 'mcl': "}) {
      EXPECT_NE(message.find(line), std::string::npos) << line << " in " << message;
    }
  }
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("HuntCrossleyForce 'floor'"), std::string::npos);
  EXPECT_NE(warnings[1].find("Ligament 'off'"), std::string::npos);
}

// The text of an error is bounded: many of one type leave room for the only one of another.
TEST(OsimReader, OfManyUnsupportedPartsEveryTypeIsNamed) {
  OsimPieces pieces;
  for (int i = 0; i < 200; ++i) {
    pieces.forces += "<Ligament name=\"l" + std::to_string(i) + "\" />\n";
  }
  pieces.forces += "<Umberger2010 name=\"last\" />";
  try {
    readOsim(makeOsim(pieces), "knee.osim");
    FAIL() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.message().rfind("201 parts", 0), 0u);
    EXPECT_NE(error.message().find("Umberger2010 'last'"), std::string::npos);
    EXPECT_NE(error.message().find(" more of these types"), std::string::npos);
    EXPECT_LE(error.message().size(), Error::kMaximumText);
  }
}

TEST(OsimReader, AnInertiaThatNoBodyCanHaveIsRaised) {
  OsimPieces pieces;
  pieces.thigh = "<inertia>0.0001 0.0002 0.001 0 0 0</inertia>";
  std::vector<std::string> warnings;
  const ModelSpec spec = readOsim(makeOsim(pieces), "foot.osim", &warnings);
  EXPECT_NEAR(spec.bodies[0].inertia[0], 0.0001, tol(1e-18));
  EXPECT_NEAR(spec.bodies[0].inertia[1], 0.0009, tol(1e-18));
  EXPECT_NEAR(spec.bodies[0].inertia[2], 0.001, tol(1e-18));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("was raised to"), std::string::npos) << warnings[0];
}

TEST(OsimReader, AxesWithoutAFunctionAreMentioned) {
  OsimPieces pieces;
  pieces.knee_transform +=
      "<TransformAxis name=\"translation1\"><coordinates>knee</coordinates>"
      "<axis>1 0 0</axis></TransformAxis>";
  std::vector<std::string> warnings;
  readOsim(makeOsim(pieces), "knee.osim", &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("translation1"), std::string::npos) << warnings[0];
}

TEST(OsimReader, BallAndFreeJointsTurnByTheirAngles) {
  OsimPieces pieces;
  pieces.version = "40000";
  std::string text = makeOsim(pieces);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("<PinJoint name=\"hip_joint\">", "<FreeJoint name=\"hip_joint\">");
  replace("</PinJoint>", "</FreeJoint>");
  replace("<Coordinate name=\"hip\" />",
          "<Coordinate name=\"a\" /><Coordinate name=\"b\" /><Coordinate name=\"c\" />"
          "<Coordinate name=\"x\" /><Coordinate name=\"y\" /><Coordinate name=\"z\" />");
  std::vector<std::string> warnings;
  const ModelSpec spec = readOsim(text, "free.osim", &warnings);
  EXPECT_EQ(spec.joints[0].kind, JointSpec::Kind::kCustom);
  EXPECT_EQ(spec.joints[0].axes[1].coordinate, "b");
  EXPECT_EQ(spec.joints[0].axes[1].axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(spec.joints[0].axes[5].coordinate, "z");
  EXPECT_EQ(findMotionKind(spec, "c"), MotionKind::kRotational);
  EXPECT_EQ(findMotionKind(spec, "x"), MotionKind::kTranslational);
  EXPECT_EQ(warnings.size(), 1u);
}

class OsimReaderShared : public SharedDataTest {
 protected:
  ModelSpec read(const std::string& relative, std::vector<std::string>* warnings = nullptr) const {
    return readOsim(readFile(shared(relative)), relative, warnings);
  }
};

int countCoordinates(const ModelSpec& spec) {
  int count = 0;
  for (const JointSpec& joint : spec.joints) {
    count += static_cast<int>(joint.coordinates.size());
  }
  return count;
}

int countWraps(const ModelSpec& spec) {
  int count = static_cast<int>(spec.ground_wrap_objects.size());
  for (const BodySpec& body : spec.bodies) {
    count += static_cast<int>(body.wrap_objects.size());
  }
  return count;
}

void expectRajagopalCounts(const ModelSpec& spec, std::size_t markers, std::size_t actuators = 17) {
  EXPECT_EQ(spec.bodies.size(), 22u);
  EXPECT_EQ(spec.joints.size(), 22u);
  EXPECT_EQ(countCoordinates(spec), 39);
  EXPECT_EQ(spec.couplers.size(), 2u);
  EXPECT_EQ(spec.muscles.size(), 80u);
  EXPECT_EQ(spec.actuators.size(), actuators);
  EXPECT_EQ(countWraps(spec), 40);
  EXPECT_EQ(spec.markers.size(), markers);
}

// spec/rajagopal2016.md 1.
TEST_F(OsimReaderShared, GenericModelHasThePublishedParts) {
  const ModelSpec spec = read("data/models/Rajagopal2016.osim");
  expectRajagopalCounts(spec, 66);
  EXPECT_NEAR(spec.calcTotalMass(), 75.337, tol(1e-12));
  EXPECT_EQ(spec.muscle_groups.size(), 26u);
  int rigid = 0;
  for (const MuscleSpec& muscle : spec.muscles) {
    rigid += muscle.tendon == TendonKind::kRigid ? 1 : 0;
  }
  EXPECT_EQ(rigid, 34);
  EXPECT_EQ(countMeshes(spec), 81);
}

// The prototypes of <defaults> give minimum control and maximum velocity; what neither they nor the
// muscle state has its class default (spec/rajagopal2016.md 1).
TEST_F(OsimReaderShared, MuscleCombinesOwnPrototypeAndClassValues) {
  const ModelSpec spec = read("data/models/Rajagopal2016.osim");
  const MuscleSpec& soleus = spec.muscles[static_cast<std::size_t>(spec.findMuscle("soleus_r"))];
  EXPECT_EQ(soleus.max_isometric_force, 6194.84262295082);
  EXPECT_EQ(soleus.optimal_fiber_length, 0.044);
  EXPECT_EQ(soleus.tendon_slack_length, 0.276755872375976);
  EXPECT_EQ(soleus.pennation_at_optimal, 0.38142888);
  EXPECT_EQ(soleus.max_contraction_velocity, 10);
  EXPECT_EQ(soleus.fiber_damping, 0.1);
  EXPECT_EQ(soleus.min_control, 0.01);
  EXPECT_EQ(soleus.max_control, 1);
  EXPECT_EQ(soleus.default_activation, 0.01);
  EXPECT_EQ(soleus.activation_time_constant, 0.01);
  EXPECT_EQ(soleus.deactivation_time_constant, 0.04);
  EXPECT_EQ(soleus.maximum_pennation, std::acos(0.1));
  EXPECT_EQ(soleus.curves.active_minimum_value, 0);
  EXPECT_EQ(soleus.curves.active_max_length, 1.9);
  EXPECT_NEAR(soleus.curves.passive_stiffness_at_one_force, 2.857142857, tol(1e-9));
  EXPECT_NEAR(soleus.curves.tendon_stiffness_at_one_force, 28.06122449, tol(1e-8));
  ASSERT_EQ(soleus.path.size(), 2u);
  EXPECT_EQ(soleus.path[1].body, "calcn_r");
  EXPECT_EQ(soleus.path[1].location, Eigen::Vector3d(0.0044, 0.031, -0.0053));
}

TEST_F(OsimReaderShared, KneeKeepsItsSplinesOffsetsAndSlots) {
  const ModelSpec spec = read("data/models/Rajagopal2016.osim");
  const JointSpec* knee = nullptr;
  for (const JointSpec& joint : spec.joints) {
    knee = joint.name == "walker_knee_l" ? &joint : knee;
  }
  ASSERT_NE(knee, nullptr);
  EXPECT_EQ(knee->parent.body, "femur_l");
  EXPECT_EQ(knee->parent.translation, Eigen::Vector3d(-0.00809, -0.40796, 0.00275));
  EXPECT_EQ(knee->child.orientation, Eigen::Vector3d(1.64157, -1.44618, 1.5708));
  EXPECT_EQ(knee->axes[0].axis, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(knee->axes[1].function.kind, FunctionSpec::Kind::kSimmSpline);
  ASSERT_EQ(knee->axes[4].function.x.size(), 13u);
  EXPECT_EQ(knee->axes[4].function.y.back(), -0.006792);
  EXPECT_EQ(knee->axes[5].coordinate, "");
  EXPECT_EQ(findMotionKind(spec, "knee_angle_l"), MotionKind::kRotational);
  EXPECT_EQ(findMotionKind(spec, "knee_angle_l_beta"), MotionKind::kCoupled);
  EXPECT_EQ(findMotionKind(spec, "pelvis_ty"), MotionKind::kTranslational);
}

// data/README.md 3: the two versions differ in damping, toes' inertia and one range only, and their
// documents have quite different layouts.
TEST_F(OsimReaderShared, OldLayoutGivesTheSameModel) {
  const ModelSpec current = read("data/models/Rajagopal2016.osim");
  const ModelSpec old = read("data/models/Rajagopal2015.osim");
  expectRajagopalCounts(old, 66);
  EXPECT_EQ(countMeshes(old), 81);
  for (std::size_t i = 0; i < current.muscles.size(); ++i) {
    const MuscleSpec& a = current.muscles[i];
    const MuscleSpec& b = old.muscles[i];
    ASSERT_EQ(a.name, b.name);
    EXPECT_NEAR(a.max_isometric_force, b.max_isometric_force, tol(1e-9));
    EXPECT_EQ(b.fiber_damping, 0.01);
    EXPECT_EQ(a.min_control, b.min_control);
    EXPECT_EQ(a.curves.active_max_length, b.curves.active_max_length);
    ASSERT_EQ(a.path.size(), b.path.size());
    for (std::size_t p = 0; p < a.path.size(); ++p) {
      EXPECT_EQ(a.path[p].body, b.path[p].body);
      EXPECT_LT((a.path[p].location - b.path[p].location).norm(), tol(1e-9));
    }
    EXPECT_EQ(a.wraps.size(), b.wraps.size());
  }
  for (const BodySpec& body : current.bodies) {
    const BodySpec& same = old.bodies[static_cast<std::size_t>(old.findBody(body.name))];
    EXPECT_EQ(body.mass, same.mass);
    EXPECT_LT((body.mass_center - same.mass_center).norm(), tol(1e-9));
    const double iyy = body.name.substr(0, 4) == "toes" ? 0.0009 : body.inertia[1];
    EXPECT_NEAR(same.inertia[1], iyy, tol(1e-9));
  }
  for (const JointSpec& joint : current.joints) {
    for (const JointSpec& other : old.joints) {
      if (joint.name == other.name) {
        EXPECT_EQ(joint.kind, other.kind);
        EXPECT_EQ(joint.parent.body, other.parent.body);
        EXPECT_EQ(joint.child.body, other.child.body);
        // The newer document was converted by OpenSim, which rounded offsets to six digits: half a
        // unit of the sixth digit of numbers below 10.
        const auto largest = [](const Eigen::Vector3d& v) {
          return v.cwiseAbs().maxCoeff();
        };
        EXPECT_LT(largest(joint.parent.translation - other.parent.translation), tol(5.1e-7));
        EXPECT_LT(largest(joint.parent.orientation - other.parent.orientation), tol(5.1e-6));
        EXPECT_LT(largest(joint.child.orientation - other.child.orientation), tol(5.1e-6));
      }
    }
  }
}

TEST_F(OsimReaderShared, ScaledSubjectsAreRead) {
  for (const char* file : {"reference/walk/scale/subject_scaled.osim",
                           "reference/walk/rra/pass1/subject_after.osim",
                           "reference/walk/subject_adjusted.osim",
                           "reference/run/scale/subject_scaled.osim",
                           "reference/run/subject_adjusted.osim",
                           "reference/run/rra/pass1/subject_after.osim",
                           "reference/run/rra/pass2/subject_after.osim"}) {
    SCOPED_TRACE(file);
    const ModelSpec spec = read(file);
    expectRajagopalCounts(spec, spec.markers.size());
    EXPECT_EQ(spec.muscles.front().fiber_damping, 0.1);
  }
  // reference/README.md: masses after the last pass.
  EXPECT_NEAR(read("reference/walk/subject_adjusted.osim").calcTotalMass(), 85.0600, tol(5e-5));
  EXPECT_NEAR(read("reference/run/subject_adjusted.osim").calcTotalMass(), 73.4292, tol(5e-5));
  EXPECT_EQ(read("reference/run/subject_adjusted.osim").muscles[7].max_contraction_velocity, 15);
}

TEST_F(OsimReaderShared, ScaledKneeSplinesCarryTheMultiplier) {
  const ModelSpec spec = read("reference/walk/scale/subject_scaled.osim");
  for (const JointSpec& joint : spec.joints) {
    if (joint.name == "walker_knee_r") {
      EXPECT_EQ(joint.axes[3].function.kind, FunctionSpec::Kind::kSimmSpline);
      EXPECT_NEAR(joint.axes[3].function.scale, 0.958, tol(1e-12));
    }
  }
}

TEST_F(OsimReaderShared, CustomMarkersetAndContactModelAreRead) {
  expectRajagopalCounts(read("data/walk/Rajagopal2015_CustomMarkerset.osim"), 131);
  std::vector<std::string> warnings;
  const ModelSpec moco = read("data/walk/moco/subject_walk_contact_bounded_80musc.osim", &warnings);
  expectRajagopalCounts(moco, 33, 0);
  EXPECT_NEAR(moco.calcTotalMass(), 85.0504, tol(5e-5));
  EXPECT_EQ(warnings.size(), 12u) << "one per contact sphere";
}

TEST_F(OsimReaderShared, PolynomialKneeIsRead) {
  const ModelSpec spec = read("data/walk/example3DWalking/subject_walk_scaled.osim");
  EXPECT_NEAR(spec.calcTotalMass(), 85.2698, tol(5e-5));
  EXPECT_EQ(countCoordinates(spec), 33);
  EXPECT_EQ(countWraps(spec), 44);
}

// data/README.md 3.
TEST_F(OsimReaderShared, DelpLineageHasConditionalAndMovingPoints) {
  struct Lineage {
    const char* file;
    MuscleKind kind;
    int coordinates;
  };
  for (const Lineage& model :
       {Lineage{"FullBodyModel_Hamner2010_v2_0", MuscleKind::kThelen2003, 37},
        Lineage{"gait2392_thelen2003muscle", MuscleKind::kThelen2003, 23},
        Lineage{"gait2392_millard2012muscle", MuscleKind::kMillard2012, 23}}) {
    SCOPED_TRACE(model.file);
    const ModelSpec spec = read(std::string("data/models/") + model.file + ".osim");
    EXPECT_NEAR(spec.calcTotalMass(), 75.1646, tol(5e-5));
    EXPECT_EQ(countCoordinates(spec), model.coordinates);
    EXPECT_EQ(spec.muscles.size(), 92u);
    int conditional = 0;
    int moving = 0;
    for (const MuscleSpec& muscle : spec.muscles) {
      EXPECT_EQ(muscle.kind, model.kind);
      for (const PathPointSpec& point : muscle.path) {
        conditional += point.kind == PathPointSpec::Kind::kConditional ? 1 : 0;
        moving += point.kind == PathPointSpec::Kind::kMoving ? 1 : 0;
      }
    }
    EXPECT_EQ(conditional, 26);
    EXPECT_EQ(moving, 8);
  }
}

// data/README.md 3: values that the distributed Thelen models state.
TEST_F(OsimReaderShared, ThelenMusclesOfGait2392StateTheirCurves) {
  const ModelSpec spec = read("data/models/gait2392_thelen2003muscle.osim");
  for (const MuscleSpec& muscle : spec.muscles) {
    EXPECT_EQ(muscle.thelen.tendon_strain_at_one_force, 0.033);
    EXPECT_EQ(muscle.thelen.passive_strain_at_one_force, 0.6);
    EXPECT_EQ(muscle.thelen.active_shape, 0.5);
    EXPECT_EQ(muscle.thelen.passive_shape, 4);
    EXPECT_NEAR(muscle.thelen.velocity_shape, 0.3, tol(1e-9));
    EXPECT_EQ(muscle.thelen.max_eccentric_force, 1.8);
    EXPECT_EQ(muscle.activation_time_constant, 0.01);
    EXPECT_EQ(muscle.deactivation_time_constant, 0.04);
  }
}

// data/README.md 3; the older document is the same model.
TEST_F(OsimReaderShared, ArnoldLegReadsAlikeFromBothDocuments) {
  std::vector<std::string> warnings;
  const ModelSpec now = read("data/models/Arnold2010_right_leg_27musc.osim", &warnings);
  const ModelSpec then = read("data/models/Arnold2010_right_leg_27musc_v30000.osim");
  EXPECT_EQ(now.document_version, 40000);
  EXPECT_EQ(then.document_version, 30000);
  EXPECT_NEAR(now.calcTotalMass(), 26.3525, tol(5e-5));
  ASSERT_EQ(now.bodies.size(), 10u);
  ASSERT_EQ(then.bodies.size(), 10u);
  int ellipsoids = 0, cylinders = 0;
  for (std::size_t b = 0; b < now.bodies.size(); ++b) {
    EXPECT_EQ(now.bodies[b].name, then.bodies[b].name);
    EXPECT_EQ(now.bodies[b].mass, then.bodies[b].mass);
    ASSERT_EQ(now.bodies[b].wrap_objects.size(), then.bodies[b].wrap_objects.size());
    for (std::size_t w = 0; w < now.bodies[b].wrap_objects.size(); ++w) {
      const WrapObjectSpec& one = now.bodies[b].wrap_objects[w];
      const WrapObjectSpec& other = then.bodies[b].wrap_objects[w];
      EXPECT_EQ(one.name, other.name);
      EXPECT_EQ(one.kind, other.kind);
      EXPECT_LT((one.semi_axes - other.semi_axes).norm(), tol(1e-12)) << one.name;
      EXPECT_LT((one.translation - other.translation).norm(), tol(1e-12)) << one.name;
      EXPECT_LT((one.rotation - other.rotation).norm(), tol(1e-12)) << one.name;
      ellipsoids += one.kind == WrapObjectSpec::Kind::kEllipsoid ? 1 : 0;
      cylinders += one.kind == WrapObjectSpec::Kind::kCylinder ? 1 : 0;
    }
  }
  EXPECT_EQ(ellipsoids, 15);
  EXPECT_EQ(cylinders, 2);
  // Of the document's 10 the patella's three are one, which equals the knee angle.
  EXPECT_EQ(countCoordinates(now), 8);
  EXPECT_EQ(countCoordinates(then), 8);
  ASSERT_EQ(now.couplers.size(), 1u);
  EXPECT_EQ(now.couplers[0].independent, "knee_angle");
  EXPECT_EQ(now.couplers[0].function.kind, FunctionSpec::Kind::kLinear);
  ASSERT_EQ(now.muscles.size(), 27u);
  ASSERT_EQ(then.muscles.size(), 27u);
  for (std::size_t m = 0; m < now.muscles.size(); ++m) {
    EXPECT_EQ(now.muscles[m].name, then.muscles[m].name);
    EXPECT_EQ(now.muscles[m].kind, MuscleKind::kSchutte1993);
    EXPECT_EQ(now.muscles[m].max_isometric_force, then.muscles[m].max_isometric_force);
    ASSERT_EQ(now.muscles[m].path.size(), then.muscles[m].path.size());
    for (std::size_t p = 0; p < now.muscles[m].path.size(); ++p) {
      EXPECT_EQ(now.muscles[m].path[p].body, then.muscles[m].path[p].body);
      EXPECT_LT((now.muscles[m].path[p].location - then.muscles[m].path[p].location).norm(),
                tol(1e-12));
    }
    ASSERT_EQ(now.muscles[m].wraps.size(), then.muscles[m].wraps.size());
  }
  // Its toes are lighter about one axis than any body can be; the warning says what was done.
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("toes") != std::string::npos &&
           warning.find("was raised to") != std::string::npos;
  }));
}

struct SharedModel {
  const char* file;
  int version;
  std::size_t bodies;
  std::size_t muscles;
};

TEST_F(OsimReaderShared, EverySharedModelIsRead) {
  const std::vector<SharedModel> models = {
      {"data/models/Rajagopal2016.osim", 40000, 22, 80},
      {"data/models/Rajagopal2015.osim", 30000, 22, 80},
      {"data/models/FullBodyModel_Hamner2010_v2_0.osim", 40000, 20, 92},
      {"data/models/gait2392_millard2012muscle.osim", 40000, 12, 92},
      {"data/models/gait2392_thelen2003muscle.osim", 40000, 12, 92},
      {"data/models/Arnold2010_right_leg_27musc.osim", 40000, 10, 27},
      {"data/models/Arnold2010_right_leg_27musc_v30000.osim", 30000, 10, 27},
      {"data/walk/moco/subject_walk_contact_bounded_80musc.osim", 40000, 22, 80},
      {"data/walk/example3DWalking/subject_walk_scaled.osim", 40500, 22, 80},
      {"data/walk/Rajagopal2015_CustomMarkerset.osim", 30000, 22, 80},
      {"data/run/hamner2013_subject04/unscaled_generic.osim", 40000, 20, 92},
  };
  for (const SharedModel& model : models) {
    SCOPED_TRACE(model.file);
    const ModelSpec spec = read(model.file);
    EXPECT_EQ(spec.document_version, model.version);
    EXPECT_EQ(spec.bodies.size(), model.bodies);
    EXPECT_EQ(spec.muscles.size(), model.muscles);
  }
}

}  // namespace
}  // namespace gaitmill
