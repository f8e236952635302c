#include "core/muscle/muscle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct LegMuscle {
  const char* name;
  double max_isometric_force;
  double optimal_fiber_length;
  double tendon_slack_length;
  double pennation_at_optimal;
  bool rigid;
  double min_fiber_length;
};
#include "tests/core/muscle/leg_muscles.inc"

MuscleSpec makeSpec(const LegMuscle& m) {
  MuscleSpec spec;
  spec.name = m.name;
  spec.max_isometric_force = m.max_isometric_force;
  spec.optimal_fiber_length = m.optimal_fiber_length;
  spec.tendon_slack_length = m.tendon_slack_length;
  spec.pennation_at_optimal = m.pennation_at_optimal;
  spec.tendon = m.rigid ? TendonKind::kRigid : TendonKind::kElastic;
  return spec;
}

// All with the curves of Rajagopal2016, made once.
Muscle makeMuscle(const MuscleSpec& spec) {
  static const auto curves = std::make_shared<const MuscleCurves>(MuscleCurvesSpec{});
  return Muscle(spec, curves);
}

const LegMuscle& findLegMuscle(const std::string& name) {
  for (const LegMuscle& muscle : kLegMuscles) {
    if (name == muscle.name || name == std::string(muscle.name) + "_r" ||
        name == std::string(muscle.name) + "_l") {
      return muscle;
    }
  }
  throw std::runtime_error("no muscle " + name);
}

Muscle makeMuscle(const std::string& name) {
  return makeMuscle(makeSpec(findLegMuscle(name)));
}

// Ten printed digits of a quantity of that size.
double printed(double value, double floor = 1e-10) {
  return tol(std::max(floor, 6e-10 * std::abs(value)));
}

// One row of a table of spec/muscle.md 12.
struct Vector {
  const char* muscle;
  double activation, path_length, path_speed, length, pennation;
  double tendon_length, active, passive, tendon;
  double norm_velocity, velocity, tendon_force, active_force, passive_force;
};

TEST(Muscle, ElasticTendonMatchesTestVectors) {
  const std::vector<Vector> vectors = {
      // clang-format off
    {"soleus", 0.6, 0.325, 0.15, 0.04, 0.4218749645, 0.288507088, 0.9691791465, 0, 0.8164959473, 0.8744416473, 1.388666056, 5058.063896, 5002.457517, 541.7028388},
    {"soleus", 0.01, 0.3, -0.1, 0.03, 0.5775373069, 0.2748657082, 0.775675462, 0, 0, -0.05771724469, 0.7440901194, 0, 35.75492476, -35.75492475},
    {"gasmed", 0.3, 0.455, -0.25, 0.05, 0.1690267796, 0.4057125524, 0.999928953, 0, 0.2157881109, -0.05643495491, 0.7485574216, 672.2910433, 699.5927999, -17.58239347},
    {"vaslat", 1, 0.31, 0.4, 0.084, 0.3005521229, 0.2297654529, 0.9213009297, 0, 0.7907129598, -0.0201346211, 0.9007209301, 4071.196962, 4272.627396, -10.3668477},
    {"recfem", 0.05, 0.52, -0.6, 0.07, 0.2356381259, 0.4519344108, 0.9788095226, 0, 0.06921422257, 0.1092778292, 1.231158729, 151.6996482, 132.060053, 23.95086968},
    {"tibant", 0.3, 0.3, 0.05, 0.055, 0.2432369174, 0.2466190095, 0.8913302925, 0, 0.3791690062, 0.3950972024, 1.313240182, 465.411929, 431.0312562, 48.49630326},
    {"glmin3", 0.6, 0.09, -0.05, 0.039, 0.01700572603, 0.05100563916, 0.9996525553, 0.001820785323, 0.01266423288, -0.5777916834, 0.1144138314, 5.658047074, 30.65960308, -25.00073777},
    {"bflh", 1, 0.42, 0.5, 0.088, 0.1953445232, 0.3336736848, 0.9636562058, 0, 0.3872265131, -0.2147539603, 0.4319065351, 508.499509, 546.5593779, -28.20113801},
    {"perlong", 0.2, 0.386, 0.02, 0.052, 0.2421145502, 0.3355166752, 0.9997590169, 0.001374617131, 0.09858532593, -0.1288419546, 0.5654198181, 109.9592551, 126.1002259, -12.83745474},
    {"semiten", 0.01, 0.46, -0.2, 0.215, 0.2161886465, 0.2500047465, 0.9460747308, 0.02033273937, 0.1189756231, 0.883280269, 1.389991987, 70.34970081, 7.775744941, 64.2505767},
      // clang-format on
  };
  for (const Vector& v : vectors) {
    SCOPED_TRACE(v.muscle);
    const Muscle muscle = makeMuscle(v.muscle);
    const FiberState state = muscle.calcElastic(v.activation, v.length, v.path_length);
    EXPECT_NEAR(std::acos(state.cos_pennation), v.pennation, printed(v.pennation));
    EXPECT_NEAR(state.tendon_length, v.tendon_length, printed(v.tendon_length));
    EXPECT_NEAR(state.active_length_multiplier, v.active, printed(v.active));
    EXPECT_NEAR(state.passive_multiplier, v.passive, printed(v.passive));
    EXPECT_NEAR(state.norm_velocity, v.norm_velocity, printed(v.norm_velocity));
    EXPECT_NEAR(state.velocity_multiplier, v.velocity, printed(v.velocity));
    // The printed forces come from a balance solved to 1e-10 F0M.
    const double force = tol(2e-10 * muscle.maxIsometricForce() + 6e-7);
    EXPECT_NEAR(state.tendon_force, v.tendon_force, force);
    EXPECT_NEAR(state.active_force, v.active_force, force);
    EXPECT_NEAR(state.passive_force, v.passive_force, force);
  }
}

TEST(Muscle, RigidTendonMatchesTestVectors) {
  struct RigidVector {
    const char* muscle;
    double activation, path_length, path_speed, length, pennation, active, passive;
    double norm_velocity, velocity, active_force, passive_force, tendon_force;
  };
  const std::vector<RigidVector> vectors = {
      // clang-format off
    {"psoas", 0.6, 0.225, 0.1, 0.1279235377, 0.1966973863, 0.9672041479, 0.01576404465, 0.08389370058, 1.21282438, 1004.216669, 34.46185453, 1018.650059},
    {"glmax2", 0.3, 0.22, -0.4, 0.1622287781, 0.3550070111, 0.9992131116, 0.003161116827, -0.2388902043, 0.4009469162, 168.9918481, -29.14438391, 131.1271429},
    {"sart", 0.05, 0.55, 0.7, 0.4261303258, 0.02471649389, 0.9941388925, 0.007997881977, 0.1736442169, 1.260765739, 15.63042379, 6.325691155, 21.94940873},
    {"addbrev", 1, 0.14, 0, 0.1052143961, 0.1124643981, 0.9998496569, 0.0009400143682, 0, 1, 625.7255845, 0.5882794837, 622.3571528},
    {"bfsh", 0.5, 0.21, -1.3, 0.1080917724, 0.2697544281, 0.9999234846, 0, -1.135981215, 0, 0, 0, 0},
    {"grac", 0.01, 0.4, -3, 0.2312960184, 0.1693764226, 0.9999416843, 0.000405393046, -1.298099307, 0, 0, 0, 0},
    {"sart", 0.5, 0.2, 0.1, 0.10075, 0.1047210781, 0, 0, 0, 1, 0, 0, 0},
      // clang-format on
  };
  for (const RigidVector& v : vectors) {
    SCOPED_TRACE(v.muscle);
    const FiberState state =
        makeMuscle(v.muscle).calcRigid(v.activation, v.path_length, v.path_speed);
    EXPECT_NEAR(state.length, v.length, printed(v.length));
    EXPECT_NEAR(std::acos(state.cos_pennation), v.pennation, printed(v.pennation));
    EXPECT_NEAR(state.active_length_multiplier, v.active, printed(v.active));
    EXPECT_NEAR(state.passive_multiplier, v.passive, printed(v.passive));
    EXPECT_NEAR(state.norm_velocity, v.norm_velocity, printed(v.norm_velocity));
    EXPECT_NEAR(state.velocity_multiplier, v.velocity, printed(v.velocity));
    EXPECT_NEAR(state.active_force, v.active_force, printed(v.active_force));
    EXPECT_NEAR(state.passive_force, v.passive_force, printed(v.passive_force));
    EXPECT_NEAR(state.tendon_force, v.tendon_force, printed(v.tendon_force));
  }
}

// Lengths to 2e-9 of the optimal length: the tolerance of the solver that made the table.
TEST(Muscle, StaticEquilibriumMatchesTestVectors) {
  struct StaticVector {
    const char* muscle;
    double activation, path_length, length, tendon_force;
  };
  const std::vector<StaticVector> vectors = {
      {"soleus", 0.01, 0.3, 0.028034057622, 34.9030846},
      {"soleus", 0.05, 0.3228365032, 0.0471784071373, 350.6045538},
      {"soleus", 1, 0.33, 0.0435990264313, 5741.059413},
      {"gasmed", 0.3, 0.455, 0.0483895065401, 916.3876901},
      {"vaslat", 0.6, 0.31, 0.0859349200151, 2767.540186},
      {"recfem", 0.05, 0.52, 0.0707710002341, 105.1287338},
      {"tibant", 1, 0.3, 0.0510686469504, 1003.370711},
      {"semiten", 0.01, 0.45, 0.207153331139, 12.17568512},
      {"perbrev", 0.3, 0.196, 0.0462119743406, 153.5068803},
      {"piri", 0.6, 0.14, 0.0218410955009, 554.6698214},
  };
  for (const StaticVector& v : vectors) {
    SCOPED_TRACE(v.muscle);
    const Muscle muscle = makeMuscle(v.muscle);
    const double length = muscle.solveStaticLength(v.activation, v.path_length);
    EXPECT_NEAR(length, v.length, tol(2e-9 * muscle.optimalFiberLength()));
    EXPECT_NEAR(muscle.calcTendonForce(length, v.path_length),
                v.tendon_force,
                tol(1e-8 * muscle.maxIsometricForce() + 1e-6));
  }
}

TEST(Muscle, MinimumFiberLengthsMatchTable) {
  for (const LegMuscle& m : kLegMuscles) {
    EXPECT_NEAR(makeMuscle(m.name).minFiberLength(), m.min_fiber_length, tol(6e-10)) << m.name;
  }
}

// At l0M, activation 1, no speed: the tendon carries F0M cos(alpha0) and no passive force.
TEST(Muscle, RigidTendonAtOptimalLengthHasItsClosedForm) {
  const LegMuscle& psoas = findLegMuscle("psoas");
  const double cos = std::cos(psoas.pennation_at_optimal);
  const double path = psoas.tendon_slack_length + psoas.optimal_fiber_length * cos;
  const double expected = psoas.max_isometric_force * cos;
  EXPECT_NEAR(makeMuscle("psoas").calcRigid(1, path, 0).tendon_force, expected, tol(1e-9));
  EXPECT_NEAR(makeMuscle("psoas").calcRigidForceLine(path, 0).gain, expected, tol(1e-9));
}

TEST(Muscle, ForceLineIsTheRigidTendonForce) {
  const LegMuscle& m = findLegMuscle("glmax2");
  const Muscle muscle = makeMuscle(m.name);
  for (const double speed : {-1.5, -0.3, 0.0, 0.4}) {
    for (const double length : {0.11, 0.2, 0.25}) {
      const Muscle::ForceLine line = muscle.calcRigidForceLine(length, speed);
      for (const double a : {0.01, 0.4, 1.0}) {
        EXPECT_NEAR(std::max(0.0, line.gain * a + line.offset),
                    muscle.calcRigid(a, length, speed).tendon_force,
                    tol(1e-10));
      }
    }
  }
}

// Every muscle, activation x length x velocity far beyond what bodies do: the balance is met.
TEST(Muscle, VelocityBalanceHoldsOnADenseGrid) {
  for (const LegMuscle& m : kLegMuscles) {
    SCOPED_TRACE(m.name);
    MuscleSpec spec = makeSpec(m);
    spec.tendon = TendonKind::kElastic;
    const Muscle muscle = makeMuscle(spec);
    for (const double a : {0.01, 0.05, 0.2, 0.5, 1.0}) {
      for (double norm = 0.1; norm < 2.2; norm += 0.05) {
        for (double tendon = 0.9; tendon < 1.12; tendon += 0.01) {
          const double fiber = std::max(norm * spec.optimal_fiber_length, muscle.minFiberLength());
          const double path = fiber + tendon * spec.tendon_slack_length;
          const FiberState s = muscle.calcElastic(a, fiber, path);
          ASSERT_TRUE(std::isfinite(s.velocity) && std::isfinite(s.tendon_force));
          const bool stuck = s.velocity == 0 && s.active_force == 0;
          const double along = (s.active_force + s.passive_force) * s.cos_pennation;
          ASSERT_TRUE(stuck ||
                      std::abs(along - s.tendon_force) <=
                          tol(1e-12) * spec.max_isometric_force * (1 + std::abs(s.norm_velocity)))
              << a << " " << norm << " " << tendon << " " << along - s.tendon_force;
        }
      }
    }
  }
}

TEST(Muscle, StaticEquilibriumIsFoundOnADenseGrid) {
  for (const LegMuscle& m : kLegMuscles) {
    SCOPED_TRACE(m.name);
    MuscleSpec spec = makeSpec(m);
    spec.tendon = TendonKind::kElastic;
    const Muscle muscle = makeMuscle(spec);
    for (const double a : {0.01, 0.05, 0.2, 0.5, 1.0}) {
      for (double stretch = -0.2; stretch < 2.5; stretch += 0.02) {
        const double path = spec.tendon_slack_length + stretch * spec.optimal_fiber_length;
        const double length = muscle.solveStaticLength(a, path);
        ASSERT_GE(length, muscle.minFiberLength());
        const FiberState s = muscle.calcElastic(a, length, path);
        ASSERT_NEAR(s.norm_velocity, 0, length > muscle.minFiberLength() ? tol(1e-9) : 10)
            << a << " " << stretch;
      }
    }
  }
}

// The stage velocity satisfies the plain balance at the length it leads to.
TEST(Muscle, StageVelocityBalancesAtTheEndOfTheStep) {
  const Muscle soleus = makeMuscle("soleus");
  for (const double step : {1e-4, 6e-4, 2.5e-3}) {
    for (const double start : {0.03, 0.044, 0.055}) {
      const double path = 0.325;
      const double v = soleus.solveStageVelocity({0.3, start, path, step}, 0);
      const FiberState at_end = soleus.calcElastic(0.3, start + step * v, path);
      EXPECT_NEAR(at_end.velocity, v, tol(1e-11));
    }
  }
}

TEST(Muscle, RefusesParametersOutOfRangeByName) {
  MuscleSpec spec = makeSpec(findLegMuscle("soleus"));
  spec.fiber_damping = 0;
  try {
    makeMuscle(spec);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMuscleParameter);
    EXPECT_EQ(error.where().field, "fiber_damping");
    EXPECT_EQ(error.where().muscle, "soleus");
    EXPECT_NE(error.message().find("'soleus'"), std::string::npos);
  }
}

TEST(Muscle, FaultsOfItsCurvesCarryItsName) {
  MuscleSpec spec = makeSpec(findLegMuscle("soleus"));
  spec.curves.tendon_curviness = 2;
  try {
    makeMuscles({spec});
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMuscleParameter);
    EXPECT_EQ(error.where().muscle, "soleus");
  }
}

TEST(Muscle, MakeMusclesKeepsOrderAndKinds) {
  const std::vector<Muscle> muscles =
      makeMuscles({makeSpec(findLegMuscle("psoas")), makeSpec(findLegMuscle("soleus"))});
  ASSERT_EQ(muscles.size(), 2u);
  EXPECT_TRUE(muscles[0].hasRigidTendon());
  EXPECT_FALSE(muscles[1].hasRigidTendon());
}

// fibers.csv of the reference models: poses x 80 muscles x static and dynamic cases. The path's
// length follows from fiber and tendon, its speed, for rigid tendons, from the fiber's.
class MuscleReference : public SharedDataTest {
 protected:
  void expectFibers(const ModelSpec& model, const std::string& file) {
    const std::vector<Muscle> muscles = makeMuscles(model.muscles);
    const CsvTable table = readCsv(shared(file));
    const auto name = static_cast<std::size_t>(table.column("muscle"));
    const auto kind = static_cast<std::size_t>(table.column("case"));
    ASSERT_GT(table.rows.size(), 3000u);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const auto at = [&](const char* column) {
        return table.number(static_cast<int>(row), table.column(column));
      };
      const std::string& muscle_name = table.rows[row][name];
      SCOPED_TRACE(muscle_name + " row " + std::to_string(row + 2));
      const Muscle& muscle = muscles[static_cast<std::size_t>(model.findMuscle(muscle_name))];
      const double a = at("activation");
      ASSERT_NEAR(muscle.activationDynamics().calcRate(a, 0.5),
                  at("activation_rate_at_excitation_0.5"),
                  tol(1e-8));
      const double length = at("fiber_length_m");
      const double path = at("tendon_length_m") + length * at("cos_pennation");
      const double force = tol(1e-5) * muscle.maxIsometricForce();
      if (muscle.hasRigidTendon()) {
        const double speed = at("fiber_velocity_m_s") / at("cos_pennation");
        ASSERT_NEAR(muscle.calcRigid(a, path, speed).tendon_force, at("tendon_force_N"), force);
      } else if (table.rows[row][kind] == "static_equilibrium") {
        const double rest = muscle.solveStaticLength(a, path);
        ASSERT_NEAR(muscle.calcTendonForce(rest, path), at("tendon_force_N"), force);
      } else {
        const FiberState state = muscle.calcElastic(a, length, path);
        ASSERT_NEAR(state.norm_velocity, at("norm_fiber_velocity"), tol(1e-6));
        ASSERT_NEAR(state.tendon_force, at("tendon_force_N"), force);
      }
    }
  }
};

TEST_F(MuscleReference, FibersOfTheGenericModelMatch) {
  expectFibers(readModelFile(shared("data/models/Rajagopal2016.osim")),
               "reference/model_rajagopal2016/fibers.csv");
}

TEST_F(MuscleReference, FibersOfTheScaledWalkerMatch) {
  expectFibers(readModelFile(shared("reference/walk/subject_adjusted.osim")),
               "reference/model_walk_adjusted/fibers.csv");
}

// The soleus of gait2392, and the same size with the other two kinds of curves.
MuscleSpec makeSoleus(MuscleKind kind) {
  MuscleSpec spec;
  spec.name = "soleus_r";
  spec.kind = kind;
  spec.max_isometric_force = 3549;
  spec.optimal_fiber_length = 0.05;
  spec.tendon_slack_length = 0.25;
  spec.pennation_at_optimal = 0.43633231;
  spec.thelen = {0.033, 0.6, 0.5, 4, 0.3, 1.8, 0.95};
  return spec;
}

Muscle makeKind(MuscleKind kind) {
  return makeMuscles({makeSoleus(kind)}).front();
}

constexpr std::array<MuscleKind, 3> kKinds = {
    MuscleKind::kMillard2012, MuscleKind::kThelen2003, MuscleKind::kSchutte1993};

// spec/muscle.md 10, from the formulas as they stand there.
TEST(ThelenMuscle, VelocityIsThatOfTheStatedRelation) {
  const Muscle muscle = makeKind(MuscleKind::kThelen2003);
  const double h = 0.05 * std::sin(0.43633231);
  const double e3 = std::exp(3.0);
  const double toe = 99 * 0.033 * e3 / (166 * e3 - 67);
  for (const double a : {0.01, 0.2, 0.9}) {
    for (double length = 0.03; length < 0.08; length += 0.0031) {
      for (double path = 0.26; path < 0.34; path += 0.0037) {
        const double cos = std::sqrt(1 - h * h / (length * length));
        const double x = (path - length * cos) / 0.25 - 1;
        const double tendon = x > toe  ? 0.67 / (0.033 - toe) * (x - toe) + 0.33
                              : x <= 0 ? 0
                                       : 0.33 * (std::exp(3 * x / toe) - 1) / (e3 - 1);
        const double l = length / 0.05;
        const double passive = l > 1 ? (std::exp(4 * (l - 1) / 0.6) - 1) / (std::exp(4.0) - 1) : 0;
        const double A = a * std::exp(-(l - 1) * (l - 1) / 0.5);
        const double y = tendon / cos - passive;
        const double k = 0.25 + 0.75 * a;
        double v = 0;
        const double limit = 0.95 * A * 1.8;
        if (y <= 0) {
          v = -k + k * (1 + 1 / 0.3) * y / A;
        } else if (y <= A) {
          v = k * (y - A) / (A + y / 0.3);
        } else {
          const double y0 = std::min(y, limit);
          const double b = (2 + 2 / 0.3) * (A * 1.8 - y0) / 0.8;
          v = k * (y0 - A) / b + (k / b + k * (y0 - A) * (2 + 2 / 0.3) / 0.8 / (b * b)) * (y - y0);
        }
        const FiberState state = muscle.calcElastic(a, length, path);
        EXPECT_NEAR(state.norm_velocity, v, tol(1e-10 * (1 + std::abs(v))))
            << a << " " << length << " " << path;
        EXPECT_NEAR(state.tendon_force, 3549 * tendon, tol(1e-9));
        EXPECT_NEAR(
            state.active_force, 3549 * y, tol(1e-8 * (3549 + std::abs(state.active_force))));
        EXPECT_NEAR(state.passive_force, 3549 * passive, tol(1e-8));
      }
    }
  }
}

// The pennation alone limits the fiber: there is no active range.
TEST(ThelenMuscle, ShortestFiberIsThatOfTheSteepestPennation) {
  const double h = 0.05 * std::sin(0.43633231);
  EXPECT_NEAR(makeKind(MuscleKind::kThelen2003).minFiberLength(), h / std::sqrt(0.99), tol(1e-15));
  MuscleSpec flat = makeSoleus(MuscleKind::kThelen2003);
  flat.pennation_at_optimal = 0;
  EXPECT_LT(makeMuscles({flat}).front().minFiberLength(), 1e-13);
}

TEST(ThelenMuscle, NeedsActivationAndAnElasticTendon) {
  MuscleSpec spec = makeSoleus(MuscleKind::kThelen2003);
  spec.minimum_activation = 0.0099;
  EXPECT_THROW(makeMuscles({spec}), Error);
  spec = makeSoleus(MuscleKind::kThelen2003);
  spec.tendon = TendonKind::kRigid;
  EXPECT_THROW(makeMuscles({spec}), Error);
  spec = makeSoleus(MuscleKind::kThelen2003);
  spec.thelen.velocity_shape = 0;
  try {
    makeMuscles({spec});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMuscleParameter);
    EXPECT_EQ(error.where().muscle, "soleus_r");
  }
}

// Faster than no load allows, the line that continues Thelen's relation is negative: as a capacity
// that counts as none.
TEST(ThelenMuscle, RigidForceIsNeverNegative) {
  const Muscle muscle = makeKind(MuscleKind::kThelen2003);
  EXPECT_EQ(muscle.calcRigidForceLine(0.3, -2).gain, 0);
  EXPECT_GE(muscle.calcRigid(0.5, 0.3, -2).tendon_force, 0);
  EXPECT_GT(muscle.calcRigidForceLine(0.3, 0).gain, 0);
}

TEST(MuscleKinds, RestWhereForcesBalance) {
  for (const MuscleKind kind : kKinds) {
    const Muscle muscle = makeKind(kind);
    for (const double a : {0.01, 0.3, 1.0}) {
      for (double path = 0.27; path < 0.33; path += 0.005) {
        const double length = muscle.solveStaticLength(a, path);
        if (length <= muscle.minFiberLength()) {
          continue;
        }
        const FiberState state = muscle.calcElastic(a, length, path);
        EXPECT_NEAR(state.velocity, 0, tol(1e-9)) << path;
        EXPECT_NEAR((state.active_force + state.passive_force) * state.cos_pennation,
                    state.tendon_force,
                    tol(1e-8 * muscle.maxIsometricForce()));
      }
    }
  }
}

// An implicit stage ends where the fiber has the velocity that brought it there.
TEST(MuscleKinds, StageVelocityIsTheVelocityAtTheStagesEnd) {
  for (const MuscleKind kind : kKinds) {
    const Muscle muscle = makeKind(kind);
    for (const double a : {0.01, 0.3, 1.0}) {
      for (double start = 0.035; start < 0.07; start += 0.0043) {
        for (double path = 0.28; path < 0.33; path += 0.006) {
          for (const double step : {0.0, 1e-4, 2e-3}) {
            const double v = muscle.solveStageVelocity({a, start, path, step}, 0);
            const double end = start + step * v;
            if (end <= muscle.minFiberLength()) {
              continue;
            }
            const FiberState state = muscle.calcElastic(a, end, path);
            EXPECT_NEAR(state.velocity, v, tol(1e-7 * (1 + std::abs(v)))) << start << " " << path;
          }
        }
      }
    }
  }
}

// Held path, constant activation: whatever the start, the fiber settles where it rests.
TEST(MuscleKinds, FiberSettlesAtRest) {
  for (const MuscleKind kind : kKinds) {
    const Muscle muscle = makeKind(kind);
    for (const double start : {0.03, 0.05, 0.065}) {
      double length = start;
      for (int step = 0; step < 3000; ++step) {
        length += 1e-3 * muscle.solveStageVelocity({0.3, length, 0.3, 1e-3}, 0);
      }
      EXPECT_NEAR(length, muscle.solveStaticLength(0.3, 0.3), tol(1e-6)) << start;
    }
  }
}

TEST(MuscleKinds, LowActivationIsHeldAtTheMinimumWhereTheBalanceNeedsIt) {
  const Muscle muscle = makeKind(MuscleKind::kThelen2003);
  EXPECT_EQ(muscle.solveStageVelocity({0, 0.05, 0.3, 1e-3}, 0),
            muscle.solveStageVelocity({0.01, 0.05, 0.3, 1e-3}, 0));
}

}  // namespace
}  // namespace gaitmill
