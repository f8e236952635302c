#include "core/sample/gait_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

// How a coordinate repeats between the steps of a symmetric gait.
enum class Side {
  kEven,   // the same in both steps: even harmonics
  kOdd,    // mirrored in the other step: odd harmonics without a mean
  kSided,  // the right side's curve; the left side's is half a cycle later
};

// Mean, cosine and sine coefficients of one coordinate [rad|m].
struct CoordinateSeries {
  const char* name;
  Side side;
  double mean;
  std::array<double, GaitMotion::kHarmonics> cosine;
  std::array<double, GaitMotion::kHarmonics> sine;
};

// Least-squares fit of both sides at once to the residual-reduced coordinates of the published
// walking trial, 0.45 to 1.80 s, phase zero at its right heel strike of 0.248 s. What symmetry
// forbids (mean list, lateral drift) is left out. RMS of the fit: legs 1.3 to 2 deg, 5 deg in hip
// rotation, pelvis 0.2 to 0.6 deg; most of it is the difference between that subject's two sides.
constexpr std::array<CoordinateSeries, 19> kSeries = {{
    {"pelvis_tilt",
     Side::kEven,
     0.0401,
     {0.0000, -0.0247, 0.0000, -0.0027, 0.0000},
     {0.0000, -0.0162, 0.0000, -0.0021, 0.0000}},
    {"pelvis_tx",
     Side::kEven,
     0.0000,
     {0.0000, -0.0131, 0.0000, -0.0030, 0.0000},
     {0.0000, 0.0109, 0.0000, -0.0000, 0.0000}},
    {"pelvis_ty",
     Side::kEven,
     0.9746,
     {0.0000, -0.0111, 0.0000, -0.0017, 0.0000},
     {0.0000, -0.0185, 0.0000, 0.0004, 0.0000}},
    {"lumbar_extension",
     Side::kEven,
     -0.1520,
     {0.0000, 0.0118, 0.0000, -0.0035, 0.0000},
     {0.0000, 0.0376, 0.0000, 0.0026, 0.0000}},
    {"pelvis_list",
     Side::kOdd,
     0.0000,
     {-0.0183, 0.0000, 0.0225, 0.0000, -0.0019},
     {-0.0407, 0.0000, 0.0110, 0.0000, -0.0023}},
    {"pelvis_rotation",
     Side::kOdd,
     0.0000,
     {0.0293, 0.0000, -0.0014, 0.0000, -0.0058},
     {0.0644, 0.0000, -0.0097, 0.0000, -0.0030}},
    {"pelvis_tz",
     Side::kOdd,
     0.0000,
     {-0.0213, 0.0000, -0.0009, 0.0000, 0.0017},
     {0.0169, 0.0000, -0.0006, 0.0000, 0.0009}},
    {"lumbar_bending",
     Side::kOdd,
     0.0000,
     {0.0009, 0.0000, -0.0285, 0.0000, 0.0037},
     {0.0592, 0.0000, -0.0129, 0.0000, 0.0028}},
    {"lumbar_rotation",
     Side::kOdd,
     0.0000,
     {-0.1362, 0.0000, 0.0027, 0.0000, 0.0067},
     {-0.0484, 0.0000, 0.0019, 0.0000, 0.0059}},
    {"hip_flexion",
     Side::kSided,
     0.1504,
     {0.3774, -0.0649, -0.0271, 0.0062, -0.0043},
     {-0.0156, -0.0242, 0.0260, -0.0006, 0.0039}},
    {"hip_adduction",
     Side::kSided,
     -0.0015,
     {-0.0134, 0.0256, -0.0280, 0.0019, 0.0065},
     {0.1068, -0.0109, -0.0147, 0.0077, 0.0025}},
    {"hip_rotation",
     Side::kSided,
     -0.0621,
     {-0.0205, 0.0172, -0.0031, 0.0042, 0.0069},
     {0.0023, -0.0018, 0.0329, 0.0035, 0.0009}},
    {"knee_angle",
     Side::kSided,
     0.4662,
     {0.0214, -0.3509, -0.0706, -0.0127, -0.0187},
     {-0.3955, 0.0151, 0.0754, 0.0045, 0.0151}},
    {"ankle_angle",
     Side::kSided,
     0.0802,
     {-0.0819, 0.1006, -0.0568, 0.0254, 0.0326},
     {0.1005, -0.0782, -0.0471, 0.0498, -0.0066}},
    {"arm_flex",
     Side::kSided,
     0.0232,
     {-0.1384, -0.0053, -0.0009, 0.0097, -0.0019},
     {-0.0217, -0.0100, 0.0049, 0.0041, -0.0025}},
    {"arm_add",
     Side::kSided,
     -0.1159,
     {0.0377, -0.0121, 0.0096, -0.0003, -0.0029},
     {0.0187, 0.0151, -0.0053, -0.0000, -0.0018}},
    {"arm_rot",
     Side::kSided,
     -0.2773,
     {-0.1401, 0.0013, -0.0046, 0.0077, 0.0041},
     {-0.0939, -0.0236, 0.0173, -0.0045, -0.0019}},
    {"elbow_flex",
     Side::kSided,
     0.7240,
     {-0.1570, 0.0573, -0.0175, -0.0026, 0.0018},
     {-0.0619, -0.0061, -0.0021, -0.0089, -0.0003}},
    {"pro_sup",
     Side::kSided,
     0.9174,
     {-0.0005, 0.0026, 0.0010, -0.0006, -0.0005},
     {0.0071, 0.0021, -0.0042, 0.0001, 0.0004}},
}};

bool isTranslation(const std::string& name) {
  return name == "pelvis_tx" || name == "pelvis_ty" || name == "pelvis_tz";
}

}  // namespace

GaitMotion::GaitMotion(const Model& model, const GaitPattern& pattern)
    : model_(model), free_(model), pattern_(pattern) {
  for (const CoordinateSeries& series : kSeries) {
    const std::string name = series.name;
    const double scale = isTranslation(name) ? pattern.length_scale : 1.0;
    Column column;
    column.mean = scale * series.mean + (name == "pelvis_ty" ? pattern.pelvis_height : 0.0);
    column.slope = name == "pelvis_tx" ? scale * pattern.speed : 0.0;
    for (std::size_t n = 0; n < kHarmonics; ++n) {
      column.terms[n] = {scale * series.cosine[n], scale * series.sine[n]};
    }
    const bool is_sided = series.side == Side::kSided;
    column.coordinate = model.getCoordinate(is_sided ? name + "_r" : name);
    columns_.push_back(column);
    if (is_sided) {
      column.coordinate = model.getCoordinate(name + "_l");
      column.delay = 0.5 * pattern.period;
      columns_.push_back(column);
    }
  }
}

void GaitMotion::calc(double t,
                      Eigen::Ref<Eigen::VectorXd> q,
                      Eigen::Ref<Eigen::VectorXd> u,
                      Eigen::Ref<Eigen::VectorXd> udot) const {
  q = model_.defaultPose();
  u.setZero();
  udot.setZero();
  for (const Column& column : columns_) {
    double value = column.mean + column.slope * t;
    double rate = column.slope;
    double acceleration = 0;
    for (std::size_t n = 0; n < kHarmonics; ++n) {
      const double w = static_cast<double>(n + 1) * 2.0 * kPi / pattern_.period;
      const double c = std::cos(w * (t - column.delay));
      const double s = std::sin(w * (t - column.delay));
      const auto& [a, b] = column.terms[n];
      value += a * c + b * s;
      rate += w * (b * c - a * s);
      acceleration -= w * w * (a * c + b * s);
    }
    q[column.coordinate.value()] = value;
    u[column.coordinate.value()] = rate;
    udot[column.coordinate.value()] = acceleration;
  }
  free_.conformPose(q);
  free_.conformRates(u);
  free_.conformRates(udot);
}

void GaitMotion::addTerm(const std::string& coordinate, int harmonic, const HarmonicTerm& term) {
  check(harmonic >= 1 && harmonic <= kHarmonics, "GaitMotion::addTerm: harmonic out of range");
  const CoordinateIndex wanted = model_.getCoordinate(coordinate);
  const auto column = std::find_if(columns_.begin(), columns_.end(), [wanted](const Column& c) {
    return c.coordinate == wanted;
  });
  require(column != columns_.end(),
          ErrorCode::kInputCoordinates,
          "the walking pattern has no coordinate '" + coordinate + "'");
  HarmonicTerm& changed = column->terms[static_cast<std::size_t>(harmonic - 1)];
  changed.cosine += term.cosine;
  changed.sine += term.sine;
}

}  // namespace gaitmill
