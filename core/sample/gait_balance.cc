#include "core/sample/gait_balance.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "core/base/units.h"
#include "core/sample/foot_loads.h"

namespace gaitmill {

namespace {

constexpr int kSamples = 50;         // over half a cycle; the other half mirrors it
constexpr int kIterations = 4;       // the fourth changes terms by less than 1e-6
constexpr Eigen::Index kErrors = 4;  // per sample: point x, z, miss x, z
// [m] forward, sideways. A foot is 20 cm long and 8 cm wide; forces of walking pass the mass centre
// within a few centimetres.
constexpr double kSigmaPointX = 0.02;
constexpr double kSigmaPointZ = 0.012;
constexpr double kSigmaMiss = 0.02;
constexpr double kSigmaShift = 0.010;
constexpr double kSigmaRotation = 0.5 * kRadiansPerDegree;
constexpr double kStep = 1e-4;  // of the differences [m|rad]

// One unknown: a cosine or sine coefficient of an odd harmonic.
struct Unknown {
  const char* coordinate;
  int harmonic;
  bool is_sine;
  double sigma;
};

void addUnknowns(const char* coordinate,
                 std::initializer_list<int> harmonics,
                 double sigma,
                 std::vector<Unknown>& unknowns) {
  for (const int harmonic : harmonics) {
    unknowns.push_back({coordinate, harmonic, false, sigma});
    unknowns.push_back({coordinate, harmonic, true, sigma});
  }
}

// What both steps share has even harmonics, what they mirror has odd ones.
std::vector<Unknown> makeUnknowns() {
  std::vector<Unknown> unknowns;
  addUnknowns("pelvis_tx", {2, 4}, kSigmaShift, unknowns);
  addUnknowns("pelvis_tilt", {2, 4}, kSigmaRotation, unknowns);
  addUnknowns("lumbar_extension", {2, 4}, kSigmaRotation, unknowns);
  addUnknowns("pelvis_tz", {1, 3, 5}, kSigmaShift, unknowns);
  addUnknowns("pelvis_list", {1, 3, 5}, kSigmaRotation, unknowns);
  addUnknowns("lumbar_bending", {1, 3, 5}, kSigmaRotation, unknowns);
  return unknowns;
}

void addTo(GaitMotion& motion, const Unknown& unknown, double change) {
  motion.addTerm(unknown.coordinate,
                 unknown.harmonic,
                 unknown.is_sine ? HarmonicTerm{0, change} : HarmonicTerm{change, 0});
}

// Errors over half a cycle, each over its sigma (kErrors x kSamples, column by column).
Eigen::VectorXd calcErrors(const GaitMotion& motion) {
  FootLoadDistribution loads(motion);
  Eigen::VectorXd errors(kErrors * kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double t = 0.5 * motion.pattern().period * i / kSamples;
    const NetReaction net = loads.calcNet(t);
    const Eigen::Vector3d offset = net.point - loads.calcTarget(t);
    const Eigen::Vector3d miss =
        net.point + net.mass_center.y() / net.force.y() * net.force - net.mass_center;
    errors.segment<kErrors>(kErrors * i) << offset.x() / kSigmaPointX, offset.z() / kSigmaPointZ,
        miss.x() / kSigmaMiss, miss.z() / kSigmaMiss;
  }
  return errors;
}

// Distance of the zero moment point from its target at a sample [m].
double findDistance(const Eigen::VectorXd& errors, Eigen::Index sample) {
  return std::hypot(kSigmaPointX * errors[kErrors * sample],
                    kSigmaPointZ * errors[kErrors * sample + 1]);
}

double calcRmsDistance(const Eigen::VectorXd& errors) {
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    sum += std::pow(findDistance(errors, i), 2);
  }
  return std::sqrt(sum / kSamples);
}

}  // namespace

BalanceReport balanceGait(GaitMotion& motion) {
  const std::vector<Unknown> unknowns = makeUnknowns();
  const auto count = static_cast<Eigen::Index>(unknowns.size());
  Eigen::VectorXd terms = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd errors = calcErrors(motion);
  BalanceReport report;
  report.rms_before = calcRmsDistance(errors);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd jacobian(errors.size(), count);
    Eigen::VectorXd prior(count);
    for (Eigen::Index j = 0; j < count; ++j) {
      const Unknown& unknown = unknowns[static_cast<std::size_t>(j)];
      addTo(motion, unknown, kStep);
      jacobian.col(j) = (calcErrors(motion) - errors) / kStep;
      addTo(motion, unknown, -kStep);
      prior[j] = 1.0 / (unknown.sigma * unknown.sigma);
    }
    const Eigen::MatrixXd normal =
        jacobian.transpose() * jacobian + Eigen::MatrixXd(prior.asDiagonal());
    const Eigen::VectorXd slope = jacobian.transpose() * errors + prior.cwiseProduct(terms);
    const Eigen::VectorXd change = -normal.ldlt().solve(slope);
    for (Eigen::Index j = 0; j < count; ++j) {
      addTo(motion, unknowns[static_cast<std::size_t>(j)], change[j]);
    }
    terms += change;
    errors = calcErrors(motion);
  }
  report.rms_after = calcRmsDistance(errors);
  for (int i = 0; i < kSamples; ++i) {
    report.largest_after = std::max(report.largest_after, findDistance(errors, i));
  }
  for (Eigen::Index j = 0; j < count; ++j) {
    const bool is_shift = unknowns[static_cast<std::size_t>(j)].sigma == kSigmaShift;
    double& largest = is_shift ? report.largest_shift : report.largest_rotation;
    largest = std::max(largest, std::abs(terms[j]));
  }
  return report;
}

}  // namespace gaitmill
