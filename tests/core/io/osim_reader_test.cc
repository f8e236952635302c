#include "core/io/osim_reader.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
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
    const double iyy = body.name.substr(0, 4) == "toes" ? 0.0002 : body.inertia[1];
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

TEST_F(OsimReaderShared, ModelsWithOtherMusclesAreRefusedByLine) {
  for (const char* file : {"data/models/Arnold2010_right_leg_27musc.osim",
                           "data/models/Arnold2010_right_leg_27musc_v30000.osim"}) {
    try {
      read(file);
      ADD_FAILURE() << file << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kModelUnsupported) << error.what();
      EXPECT_GT(error.where().line, 1) << error.what();
      EXPECT_GT(error.where().column, 1) << error.what();
    }
  }
}

}  // namespace
}  // namespace gaitmill
