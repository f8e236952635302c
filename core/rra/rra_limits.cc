#include "core/rra/rra_limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {
namespace {

constexpr double kCentimetersPerMeter = 100;

void addDeviation(const CoordinateDeviation& deviation,
                  const RraLimits& limits,
                  std::vector<LimitedFigure>& figures) {
  const bool translation = deviation.translation;
  const double unit = translation ? kCentimetersPerMeter : kDegreesPerRadian;
  const char* const unit_name = translation ? "cm" : "deg";
  figures.push_back({deviation.coordinate + " RMS",
                     unit * deviation.rms,
                     unit * (translation ? limits.translation_rms : limits.rotation_rms),
                     unit_name});
  figures.push_back({deviation.coordinate + " peak",
                     unit * deviation.peak,
                     unit * (translation ? limits.translation_peak : limits.rotation_peak),
                     unit_name});
}

}  // namespace

RraLimits resolveLimits(const RraLimits& limits, const GroundReaction& reaction) {
  Eigen::VectorXd vertical = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reaction.time.size()));
  for (const ExternalForce& force : reaction.forces) {
    vertical += force.force.row(1).transpose();
  }
  RraLimits resolved = limits;
  if (vertical.size() > 0) {
    resolved.force_peak =
        std::max(limits.force_peak, limits.force_peak_share * vertical.maxCoeff());
  }
  return resolved;
}

std::vector<CoordinateDeviation> calcDeviations(const TimeSeries& errors, const RraLimits& limits) {
  std::vector<CoordinateDeviation> deviations;
  for (int c = 0; c < errors.columnCount(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    CoordinateDeviation deviation;
    deviation.coordinate = errors.labels[i];
    deviation.translation = errors.units[i] == "m";
    deviation.rms = std::sqrt(errors.values.col(c).squaredNorm() / errors.rowCount());
    deviation.peak = errors.values.col(c).cwiseAbs().maxCoeff();
    deviation.share = deviation.translation ? std::max(deviation.rms / limits.translation_rms,
                                                       deviation.peak / limits.translation_peak)
                                            : std::max(deviation.rms / limits.rotation_rms,
                                                       deviation.peak / limits.rotation_peak);
    deviations.push_back(deviation);
  }
  return deviations;
}

std::vector<LimitedFigure> listFigures(const RraPassResult& pass, const RraLimits& limits) {
  std::vector<LimitedFigure> figures;
  for (const CoordinateDeviation& deviation : pass.deviations) {
    addDeviation(deviation, limits, figures);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string force = std::string("F") + "XYZ"[axis];
    const std::string moment = std::string("M") + "XYZ"[axis];
    const ResidualStatistics& residuals = pass.residuals;
    figures.push_back({force + " RMS", residuals.rms.force(axis), limits.force_rms, "N"});
    figures.push_back({force + " peak", residuals.peak.force(axis), limits.force_peak, "N"});
    figures.push_back({moment + " RMS", residuals.rms.moment(axis), limits.moment_rms, "N.m"});
    figures.push_back({moment + " peak", residuals.peak.moment(axis), limits.moment_peak, "N.m"});
  }
  return figures;
}

double calcMerit(const std::vector<LimitedFigure>& figures) {
  double merit = 0;
  for (const LimitedFigure& figure : figures) {
    merit += std::max(0.0, figure.share() - 1);
  }
  return merit;
}

void assessPass(const RraLimits& limits, RraPassResult& pass) {
  pass.deviations = calcDeviations(pass.tracking_errors, limits);
  pass.merit = calcMerit(listFigures(pass, limits));
  pass.decision =
      "as the settings list it; sum of what exceeds the limits " + formatFixed(pass.merit, 3);
}

}  // namespace gaitmill
