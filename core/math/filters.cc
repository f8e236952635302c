#include "core/math/filters.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {
namespace {

using Complex = std::complex<double>;

void requireCutoff(double cutoff, double rate) {
  require(cutoff > 0 && cutoff < 0.5 * rate,
          ErrorCode::kInputValue,
          "filter cutoff of " + std::to_string(cutoff) + " Hz lies outside (0, " +
              std::to_string(0.5 * rate) + ") Hz");
}

// Pole k = 1..order of the analog prototype with cutoff 1; conjugates are k and order+1-k.
Complex calcPrototypePole(int k, int order) {
  return std::polar(1.0, kPi * (2 * k + order - 1) / (2 * order));
}

// Section with numerator gain (1, zeros, product) and the two digital poles p and q.
FilterSection makeSection(Complex p, Complex q, double b1, double b2, double gain) {
  return {gain, gain * b1, gain * b2, -(p + q).real(), (p * q).real()};
}

Complex toDigital(Complex s) {
  return (1.0 + s) / (1.0 - s);
}

Complex calcResponse(const FilterSection& section, Complex z) {
  const Complex z1 = 1.0 / z;
  return (section.b0 + z1 * (section.b1 + z1 * section.b2)) /
         (1.0 + z1 * (section.a1 + z1 * section.a2));
}

// Scales the section to gain 1 at z.
void normalize(FilterSection& section, Complex z) {
  const double gain = 1 / std::abs(calcResponse(section, z));
  section.b0 *= gain;
  section.b1 *= gain;
  section.b2 *= gain;
}

// One section over a column in place, forward, from the steady state of `start` as constant input.
void runSection(const FilterSection& s, double start, Eigen::Ref<Eigen::VectorXd> x) {
  const double settled = start * (s.b0 + s.b1 + s.b2) / (1 + s.a1 + s.a2);
  // Transposed form: w1, w2 hold what past samples owe to the next two outputs.
  double w2 = s.b2 * start - s.a2 * settled;
  double w1 = s.b1 * start - s.a1 * settled + w2;
  for (double& sample : x) {
    const double input = sample;
    sample = s.b0 * input + w1;
    w1 = s.b1 * input - s.a1 * sample + w2;
    w2 = s.b2 * input - s.a2 * sample;
  }
}

void runCascade(const FilterCascade& filter, Eigen::Ref<Eigen::VectorXd> x) {
  for (const FilterSection& section : filter.sections) runSection(section, x(0), x);
}

Eigen::VectorXd extendOdd(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index length) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd extended(n + 2 * length);
  extended.segment(length, n) = x;
  for (Eigen::Index k = 1; k <= length; ++k) {
    extended(length - k) = 2 * x(0) - x(k);
    extended(length + n - 1 + k) = 2 * x(n - 1) - x(n - 1 - k);
  }
  return extended;
}

// K1, K2, C of Robertson & Dowling: one pass of the critically damped section.
FilterSection makeCriticallyDampedSection(int passes, double cutoff, double rate) {
  const double correction = 1 / std::sqrt(std::pow(2.0, 1.0 / (2 * passes)) - 1);
  const double omega = std::tan(kPi * correction * cutoff / rate);
  const double square = omega * omega;
  const double a0 = square / (1 + 2 * omega + square);
  const double b1 = 2 * a0 * (1 / square - 1);
  const double b2 = 1 - (4 * a0 + b1);
  return {a0, 2 * a0, a0, -b1, -b2};
}

// One pass as published: the first two outputs stay zero.
void runFromZero(const FilterSection& s, Eigen::Ref<Eigen::VectorXd> x) {
  double x2 = x.size() > 0 ? x(0) : 0;
  double x1 = x.size() > 1 ? x(1) : 0;
  double y1 = 0;
  double y2 = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (k < 2) {
      x(k) = 0;
      continue;
    }
    const double input = x(k);
    const double output = s.b0 * input + s.b1 * x1 + s.b2 * x2 - s.a1 * y1 - s.a2 * y2;
    x(k) = output;
    x2 = x1;
    x1 = input;
    y2 = y1;
    y1 = output;
  }
}

}  // namespace

FilterCascade makeButterworthLowPass(int order, double cutoff, double rate, CutoffMeaning meaning) {
  require(order >= 1, ErrorCode::kInputValue, "filter order must be at least 1");
  requireCutoff(cutoff, rate);
  double omega = std::tan(kPi * cutoff / rate);
  if (meaning == CutoffMeaning::kBothPasses) {
    omega /= std::pow(std::sqrt(2.0) - 1, 1.0 / (2 * order));
  }
  FilterCascade filter;
  for (int k = 1; 2 * k <= order; ++k) {
    const Complex pole = toDigital(omega * calcPrototypePole(k, order));
    filter.sections.push_back(makeSection(pole, std::conj(pole), 2, 1, 1));
  }
  if (order % 2 == 1) {
    const double pole = (1 - omega) / (1 + omega);
    filter.sections.push_back({1, 1, 0, -pole, 0});
  }
  for (FilterSection& section : filter.sections) normalize(section, 1.0);
  filter.edge_length = 3 * (order + 1);
  return filter;
}

FilterCascade makeButterworthBandPass(int order, double low, double high, double rate) {
  require(order >= 1, ErrorCode::kInputValue, "filter order must be at least 1");
  require(low < high, ErrorCode::kInputValue, "band-pass needs its lower edge below the upper");
  requireCutoff(low, rate);
  requireCutoff(high, rate);
  const double omega1 = std::tan(kPi * low / rate);
  const double omega2 = std::tan(kPi * high / rate);
  const double width = omega2 - omega1;
  const double center = std::sqrt(omega1 * omega2);
  const Complex z_center = std::polar(1.0, 2 * std::atan(center));

  FilterCascade filter;
  // Each prototype pole p gives the roots of s^2 - p B s + w0^2; a conjugate pair of p gives two
  // conjugate pairs, one section each. The real p of an odd order gives one pair by itself.
  const auto addPair = [&](Complex s, Complex t) {
    FilterSection section = makeSection(toDigital(s), toDigital(t), 0, -1, 1);
    normalize(section, z_center);
    filter.sections.push_back(section);
  };
  for (int k = 1; 2 * k <= order + 1; ++k) {
    const Complex half = 0.5 * width * calcPrototypePole(k, order);
    const Complex root = std::sqrt(half * half - center * center);
    if (2 * k == order + 1) {
      addPair(half + root, half - root);
    } else {
      addPair(half + root, std::conj(half + root));
      addPair(half - root, std::conj(half - root));
    }
  }
  filter.edge_length = 3 * (2 * order + 1);
  return filter;
}

void filterZeroPhase(const FilterCascade& filter, RowMatrix& values) {
  const Eigen::Index rows = values.rows();
  require(rows >= 2, ErrorCode::kTableShape, "a filter needs at least two rows");
  const Eigen::Index length = std::min<Eigen::Index>(filter.edge_length, rows - 1);
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    Eigen::VectorXd x = extendOdd(values.col(column), length);
    runCascade(filter, x);
    x.reverseInPlace();
    runCascade(filter, x);
    x.reverseInPlace();
    values.col(column) = x.segment(length, rows);
  }
}

void filterCriticallyDamped(
    int passes, double cutoff, double rate, EdgeTreatment edges, RowMatrix& values) {
  require(passes > 0 && passes % 2 == 0,
          ErrorCode::kInputValue,
          "a zero-lag filter needs an even number of passes");
  requireCutoff(cutoff, rate);
  const FilterSection section = makeCriticallyDampedSection(passes, cutoff, rate);
  // Three time constants of the cutoff hold the transient (spec/signal.md 2).
  const auto wanted = static_cast<Eigen::Index>(std::max(3 * rate / cutoff, 10.0));
  const Eigen::Index length =
      edges == EdgeTreatment::kReflected ? std::min(wanted, values.rows() - 1) : 0;
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    Eigen::VectorXd x = extendOdd(values.col(column), length);
    for (int pass = 0; pass < passes; ++pass) {
      if (edges == EdgeTreatment::kReflected) {
        runSection(section, x(0), x);
      } else {
        runFromZero(section, x);
      }
      x.reverseInPlace();
    }
    values.col(column) = x.segment(length, values.rows());
  }
}

}  // namespace gaitmill
