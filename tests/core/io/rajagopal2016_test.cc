// The project's own model document against the paper and against the published model.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/io/files.h"
#include "core/io/model_table.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const std::string kDocument = "models/rajagopal2016/rajagopal2016.osim";

const ModelSpec& getModel() {
  static const ModelSpec spec = readOsim(readFile(kDocument), kDocument);
  return spec;
}

const MuscleSpec& getMuscle(const std::string& name) {
  return getModel().muscles.at(static_cast<std::size_t>(getModel().findMuscle(name)));
}

/// One row of Table II of Rajagopal et al. (2016).
struct TableRow {
  const char* muscle;
  double force;      ///< [N]
  double fiber_cm;   ///< optimal fiber length
  double tendon_cm;  ///< tendon slack length
  bool rigid;        ///< the paper's asterisk
  double pennation_deg;
};
const TableRow kTableTwo[] = {
    {"addbrev", 626, 10.3, 3.5, true, 6.6},     {"addlong", 917, 10.8, 13.2, false, 7.9},
    {"addmagDist", 597, 17.7, 8.7, true, 11.2}, {"addmagIsch", 597, 15.6, 21.6, false, 9.6},
    {"addmagMid", 597, 13.8, 4.7, true, 11.9},  {"addmagProx", 597, 10.6, 4.0, true, 17.8},
    {"bflh", 1313, 9.8, 32.5, false, 10.1},     {"bfsh", 557, 11.0, 10.6, true, 15.1},
    {"edl", 603, 6.9, 36.9, false, 12.5},       {"ehl", 286, 7.5, 32.7, false, 11.3},
    {"fdl", 423, 4.5, 37.9, false, 12.9},       {"fhl", 908, 5.3, 35.4, false, 14.8},
    {"gaslat", 1575, 5.9, 37.6, false, 12.0},   {"gasmed", 3116, 5.1, 39.9, false, 9.5},
    {"glmax1", 984, 14.7, 4.9, true, 20.3},     {"glmax2", 1406, 15.7, 6.8, true, 21.0},
    {"glmax3", 948, 16.7, 7.0, true, 21.9},     {"glmed1", 1093, 7.3, 5.6, true, 18.1},
    {"glmed2", 765, 7.3, 6.5, true, 18.1},      {"glmed3", 871, 7.3, 4.5, true, 18.1},
    {"glmin1", 374, 6.8, 1.6, true, 10.0},      {"glmin2", 395, 5.6, 2.6, true, 0.0},
    {"glmin3", 447, 3.8, 5.1, false, 1.0},      {"grac", 281, 22.8, 17.2, true, 9.9},
    {"iliacus", 1021, 10.7, 9.6, true, 16.0},   {"perbrev", 521, 4.5, 14.8, false, 11.8},
    {"perlong", 1115, 5.1, 33.2, false, 14.2},  {"piri", 1030, 2.6, 11.5, false, 10.0},
    {"psoas", 1427, 11.7, 10.0, true, 12.3},    {"recfem", 2192, 7.6, 44.9, false, 12.4},
    {"sart", 249, 40.3, 12.4, true, 1.5},       {"semimem", 2201, 6.9, 34.8, false, 14.6},
    {"semiten", 591, 19.3, 24.7, false, 13.8},  {"soleus", 6195, 4.4, 27.7, false, 21.9},
    {"tfl", 411, 9.5, 45.0, false, 3.0},        {"tibant", 1227, 6.8, 24.1, false, 11.2},
    {"tibpost", 1730, 3.8, 28.1, false, 13.0},  {"vasint", 1697, 9.9, 20.2, false, 3.6},
    {"vaslat", 5149, 9.9, 22.1, false, 14.5},   {"vasmed", 2748, 9.7, 20.0, false, 24.2},
};

TEST(Rajagopal2016, HasThePartsOfThePaper) {
  const ModelCounts counts = countModel(getModel());
  EXPECT_EQ(counts.bodies, 22);
  EXPECT_EQ(counts.coordinates, 39);
  EXPECT_EQ(counts.coordinates - counts.coupled_coordinates, 37) << "degrees of freedom";
  EXPECT_EQ(counts.locked_coordinates, 8);
  EXPECT_EQ(counts.muscles, 80);
  EXPECT_EQ(counts.rigid_tendons, 34);
  EXPECT_EQ(counts.actuators, 17);
  EXPECT_EQ(counts.wrap_cylinders, 40);
  EXPECT_EQ(counts.markers, 66);
  EXPECT_EQ(getModel().muscle_groups.size(), 26u);
  EXPECT_NEAR(getModel().calcTotalMass(), 75.337, tol(1e-12));
}

// To the printed digit. The three tendon lengths of the paper that are not the rounded model value
// (44.849, 44.950 and 24.046 cm) stand 0.05 cm + 0.0046 cm away at most.
TEST(Rajagopal2016, MusclesAreThoseOfTableTwo) {
  int beyond_rounding = 0;
  for (const TableRow& row : kTableTwo) {
    SCOPED_TRACE(row.muscle);
    for (const char* side : {"_r", "_l"}) {
      const MuscleSpec& muscle = getMuscle(std::string(row.muscle) + side);
      EXPECT_EQ(std::round(muscle.max_isometric_force), row.force);
      EXPECT_NEAR(muscle.optimal_fiber_length * 100, row.fiber_cm, tol(0.05 + 1e-9));
      EXPECT_NEAR(toDegrees(muscle.pennation_at_optimal), row.pennation_deg, tol(0.05 + 1e-9));
      EXPECT_EQ(muscle.tendon == TendonKind::kRigid, row.rigid);
      const double difference = std::abs(muscle.tendon_slack_length * 100 - row.tendon_cm);
      EXPECT_LT(difference, tol(0.055));
      beyond_rounding += difference > 0.05 + 1e-9 ? 1 : 0;
    }
  }
  EXPECT_EQ(beyond_rounding, 2 * 3) << "recfem, tfl and tibant on either side";
}

TEST(Rajagopal2016, TendonIsRigidWhereItIsShorterThanTheFibers) {
  for (const MuscleSpec& muscle : getModel().muscles) {
    EXPECT_EQ(muscle.tendon == TendonKind::kRigid,
              muscle.tendon_slack_length < muscle.optimal_fiber_length)
        << muscle.name;
  }
}

TEST(Rajagopal2016, DampingAndVelocityAreTheGenericOnes) {
  for (const MuscleSpec& muscle : getModel().muscles) {
    EXPECT_EQ(muscle.fiber_damping, 0.1) << muscle.name;
    EXPECT_EQ(muscle.max_contraction_velocity, 10) << muscle.name;
  }
}

// F0M = 60 N/cm^2 phi V_total / l0M with the paper's equations 2 and 3: the sum of the muscles'
// volume fractions is 97.413 % of one limb (spec/rajagopal2016.md 15).
TEST(Rajagopal2016, VolumesAddUpToTheLimb) {
  const double limb_volume = 47.0 * 75.0 * 1.70 + 1285.0;  // [cm^3]
  double volume = 0;
  for (const TableRow& row : kTableTwo) {
    const MuscleSpec& muscle = getMuscle(std::string(row.muscle) + "_r");
    volume += muscle.max_isometric_force * muscle.optimal_fiber_length * 100 / 60.0;
  }
  EXPECT_NEAR(100 * volume / limb_volume, 97.413, tol(5e-4));
}

std::string otherSide(std::string name) {
  const std::size_t at = name.rfind("_r");
  return at == std::string::npos ? name : name.replace(at, 2, "_l");
}

Eigen::Vector3d mirrorPoint(const Eigen::Vector3d& p) {
  return {p[0], p[1], -p[2]};
}

Eigen::Vector3d mirrorAngles(const Eigen::Vector3d& a) {
  return {-a[0], -a[1], a[2]};
}

bool isRight(const std::string& name) {
  return name.size() > 2 && name.substr(name.size() - 2) == "_r";
}

TEST(Rajagopal2016, LeftBodiesAndWrapsMirrorTheRight) {
  for (const BodySpec& right : getModel().bodies) {
    const BodySpec& left =
        getModel().bodies.at(static_cast<std::size_t>(getModel().findBody(otherSide(right.name))));
    EXPECT_EQ(right.mass, left.mass);
    EXPECT_EQ(right.inertia, left.inertia);
    for (const WrapObjectSpec& wrap : right.wrap_objects) {
      if (!isRight(wrap.name)) {
        continue;
      }
      const auto twin = std::find_if(
          left.wrap_objects.begin(), left.wrap_objects.end(), [&](const WrapObjectSpec& w) {
            return w.name == otherSide(wrap.name);
          });
      ASSERT_NE(twin, left.wrap_objects.end()) << wrap.name;
      EXPECT_EQ(twin->translation, mirrorPoint(wrap.translation)) << wrap.name;
      EXPECT_EQ(twin->rotation, mirrorAngles(wrap.rotation)) << wrap.name;
      EXPECT_EQ(twin->radius, wrap.radius);
      EXPECT_EQ(twin->length, wrap.length);
      // The one exception: same geometry, but only the right one asks for a half space.
      EXPECT_EQ(twin->quadrant, wrap.name == "BF_at_gastroc_r" ? "all" : wrap.quadrant);
    }
  }
}

TEST(Rajagopal2016, LeftMusclesMirrorTheRight) {
  for (const MuscleSpec& right : getModel().muscles) {
    if (!isRight(right.name)) {
      continue;
    }
    const MuscleSpec& left = getMuscle(otherSide(right.name));
    EXPECT_EQ(left.max_isometric_force, right.max_isometric_force);
    EXPECT_EQ(left.optimal_fiber_length, right.optimal_fiber_length);
    EXPECT_EQ(left.tendon_slack_length, right.tendon_slack_length);
    EXPECT_EQ(left.pennation_at_optimal, right.pennation_at_optimal);
    ASSERT_EQ(left.path.size(), right.path.size());
    for (std::size_t i = 0; i < left.path.size(); ++i) {
      EXPECT_EQ(left.path[i].body, otherSide(right.path[i].body));
      EXPECT_EQ(left.path[i].location, mirrorPoint(right.path[i].location)) << right.name;
    }
    ASSERT_EQ(left.wraps.size(), right.wraps.size());
    for (std::size_t i = 0; i < left.wraps.size(); ++i) {
      EXPECT_EQ(left.wraps[i].wrap_object, otherSide(right.wraps[i].wrap_object));
      EXPECT_EQ(left.wraps[i].first_point, right.wraps[i].first_point);
    }
  }
}

TEST(Rajagopal2016, LeftJointOffsetsMirrorTheRight) {
  for (const JointSpec& right : getModel().joints) {
    if (!isRight(right.name)) {
      continue;
    }
    for (const JointSpec& left : getModel().joints) {
      if (left.name != otherSide(right.name)) {
        continue;
      }
      EXPECT_EQ(left.parent.translation, mirrorPoint(right.parent.translation)) << right.name;
      EXPECT_EQ(left.child.translation, mirrorPoint(right.child.translation)) << right.name;
      Eigen::Vector3d expected = mirrorAngles(right.parent.orientation);
      if (right.name == "mtp_r") {
        expected[0] = -expected[0];  // -pi and pi as printed: 5.3e-6 rad apart
      }
      if (right.kind == JointSpec::Kind::kUniversal) {
        // The wrist turns about x and y of its frame, not z: the mirrored frame is another one.
        expected[2] = -expected[2];
      }
      EXPECT_EQ(left.parent.orientation, expected) << right.name;
      EXPECT_EQ(left.child.orientation, expected) << right.name;
    }
  }
}

// spec/rajagopal2016.md 13.
TEST(Rajagopal2016, BodiesNameTheirMeshes) {
  const auto meshes = [](const char* body) {
    return getModel().bodies.at(static_cast<std::size_t>(getModel().findBody(body))).meshes;
  };
  ASSERT_EQ(meshes("tibia_l").size(), 2u);
  EXPECT_EQ(meshes("tibia_l")[0].file, "l_tibia.vtp");
  EXPECT_EQ(meshes("tibia_l")[0].scale_factors, Eigen::Vector3d::Ones());
  ASSERT_EQ(meshes("hand_r").size(), 27u);
  EXPECT_EQ(meshes("hand_r")[0].file, "pisiform_rvs.vtp");
  EXPECT_EQ(meshes("hand_r")[0].scale_factors, 0.85 * Eigen::Vector3d::Ones());
}

TEST(Rajagopal2016, DocumentIsWhatOurWriterWrites) {
  EXPECT_EQ(writeOsim(getModel()), readFile(kDocument));
}

class Rajagopal2016Shared : public SharedDataTest {};

// Every number of the published document, bit for bit; only the credits differ.
TEST_F(Rajagopal2016Shared, IsThePublishedModel) {
  const std::string path = "data/models/Rajagopal2016.osim";
  ModelSpec published = readOsim(readFile(shared(path)), path);
  published.credits = getModel().credits;
  EXPECT_EQ(writeOsim(published), writeOsim(getModel()));
}

}  // namespace
}  // namespace gaitmill
