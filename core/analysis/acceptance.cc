#include "core/analysis/acceptance.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A joint's figures in N.m: hip, knee, ankle.
using Joints = std::array<double, 3>;

// Published figures of one trial (spec/paper_metrics.md) and what OpenSim 4.6 reaches on the same
// files with the published set-ups; its RRA figures are of the pass that the published script
// reports, computed from its kinematics against the filtered inverse kinematics.
struct Figures {
  double cmc_rms_deg;
  double cmc_rms_cm;
  Joints rmse;
  Joints peak_difference;
  double rmse_percent;
  double peak_difference_percent;
  double opensim_cmc_rms_deg;
  double opensim_cmc_rms_cm;
  Joints opensim_rmse;
  Joints opensim_peak_difference;
  std::array<double, 6> opensim_residuals;
  double opensim_reserve;
  TrackingError opensim_rra;
};

// Bounds on RRA are the same for both trials.
constexpr double kRraMaxDeg = 2.0;
constexpr double kRraMaxCm = 2.0;
constexpr double kRraRmsDeg = 1.75;
constexpr double kRraRmsCm = 1.0;

const Figures kWalk = {1.0,
                       0.1,
                       {0.4, 1.0, 0.3},
                       {1.0, 3.0, 1.0},
                       2.0,
                       6.0,
                       0.26,
                       0.03,
                       {0.34, 0.52, 0.26},
                       {2.5, 1.6, 1.3},
                       {8.2, 7.5, 6.6, 23, 12, 25},
                       1.7,
                       {2.71, 0.80, 1.51, 2.63, 0.38, "", ""}};
const Figures kRun = {4.0,
                      0.2,
                      {3.0, 7.0, 5.0},
                      {9.0, 26.0, 14.0},
                      3.0,
                      11.0,
                      1.07,
                      0.07,
                      {3.0, 6.4, 2.5},
                      {8.8, 19.5, 9.8},
                      {6.6, 21.5, 9.1, 29, 24, 39},
                      24,
                      {1.97, 1.89, 1.00, 1.74, 1.00, "", ""}};
constexpr std::array<const char*, 3> kJointNames = {"hip", "knee", "ankle"};

void addTracking(const AcceptanceInput& input,
                 const Figures& figures,
                 std::vector<AcceptanceRow>& rows) {
  const auto bound = PublishedAs::kBound;
  const TrackingError& opensim = figures.opensim_rra;
  rows.push_back(
      {"RRA, largest rotation", "deg", input.rra.max_deg, kRraMaxDeg, opensim.max_deg, bound});
  rows.push_back(
      {"RRA, largest translation", "cm", input.rra.max_cm, kRraMaxCm, opensim.max_cm, bound});
  rows.push_back({"RRA, largest RMS rotation",
                  "deg",
                  input.rra.max_rms_deg,
                  kRraRmsDeg,
                  opensim.max_rms_deg,
                  bound});
  rows.push_back({"RRA, the same as the script prints it",
                  "0.01 rad",
                  input.rra.max_rms_centiradian,
                  kRraRmsDeg,
                  opensim.max_rms_centiradian,
                  bound});
  rows.push_back({"RRA, largest RMS translation",
                  "cm",
                  input.rra.max_rms_cm,
                  kRraRmsCm,
                  opensim.max_rms_cm,
                  bound});
  rows.push_back({"CMC, largest RMS rotation",
                  "deg",
                  input.cmc.max_rms_deg,
                  figures.cmc_rms_deg,
                  figures.opensim_cmc_rms_deg,
                  bound});
  rows.push_back({"CMC, largest RMS translation",
                  "cm",
                  input.cmc.max_rms_cm,
                  figures.cmc_rms_cm,
                  figures.opensim_cmc_rms_cm,
                  bound});
}

void addMoments(const std::vector<MomentComparison>& moments,
                const Figures& figures,
                std::vector<AcceptanceRow>& rows) {
  for (std::size_t j = 0; j < kJointNames.size(); ++j) {
    const MomentComparison& moment = moments[j];
    const std::string joint = kJointNames[j];
    const double opensim_percent = 100.0 / moment.peak;
    rows.push_back({joint + " moment, RMS difference",
                    "N m",
                    moment.rmse,
                    figures.rmse[j],
                    figures.opensim_rmse[j],
                    PublishedAs::kValue});
    rows.push_back({joint + " moment, RMS difference",
                    "% of peak",
                    moment.rmse_percent_of_peak,
                    figures.rmse_percent,
                    figures.opensim_rmse[j] * opensim_percent,
                    PublishedAs::kBound});
    rows.push_back({joint + " moment, largest difference",
                    "N m",
                    moment.peak_difference,
                    figures.peak_difference[j],
                    figures.opensim_peak_difference[j],
                    PublishedAs::kValue});
    rows.push_back({joint + " moment, largest difference",
                    "% of peak",
                    moment.peak_difference_percent_of_peak,
                    figures.peak_difference_percent,
                    figures.opensim_peak_difference[j] * opensim_percent,
                    PublishedAs::kBound});
    rows.push_back({joint + " moment, instants with 90 % from muscles",
                    "%",
                    100.0 * moment.fraction_at_90_percent,
                    kNan,
                    kNan,
                    PublishedAs::kNothing});
  }
}

void addActuators(const AcceptanceInput& input,
                  const Figures& figures,
                  std::vector<AcceptanceRow>& rows) {
  for (std::size_t i = 0; i < input.residuals.size(); ++i) {
    const ActuatorStatistics& residual = input.residuals[i];
    rows.push_back({"residual " + residual.name + ", peak",
                    i < 3 ? "N" : "N m",
                    residual.peak,
                    kNan,
                    i < figures.opensim_residuals.size() ? figures.opensim_residuals[i] : kNan,
                    PublishedAs::kNothing});
  }
  if (!input.reserves.empty()) {
    const ActuatorStatistics& reserve = findLargestPeak(input.reserves);
    rows.push_back({"largest reserve (" + reserve.name + ")",
                    "N m",
                    reserve.peak,
                    kNan,
                    figures.opensim_reserve,
                    PublishedAs::kNothing});
  }
}

std::string renderNumber(double value) {
  if (std::isnan(value)) {
    return "-";
  }
  return formatFixed(value, std::abs(value) < 10 ? 2 : 1);
}

std::string renderPublished(const AcceptanceRow& row) {
  return (row.published_as == PublishedAs::kBound ? "< " : "") + renderNumber(row.paper);
}

}  // namespace

bool AcceptanceRow::isMet() const {
  switch (published_as) {
    case PublishedAs::kNothing:
      return true;
    case PublishedAs::kBound:
      return ours < paper;
    case PublishedAs::kValue:
      return ours < 2.0 * paper;
  }
  return false;
}

std::vector<AcceptanceRow> makeAcceptanceTable(PaperTrial trial, const AcceptanceInput& input) {
  check(input.moments.size() == kJointNames.size(), "the acceptance list needs three moments");
  const Figures& figures = trial == PaperTrial::kWalk ? kWalk : kRun;
  std::vector<AcceptanceRow> rows;
  addTracking(input, figures, rows);
  addMoments(input.moments, figures, rows);
  addActuators(input, figures, rows);
  return rows;
}

std::string renderAcceptanceTable(const std::vector<AcceptanceRow>& rows) {
  std::ostringstream text;
  const auto line = [&text](const std::string& quantity,
                            const std::string& unit,
                            const std::string& ours,
                            const std::string& paper,
                            const std::string& opensim,
                            const std::string& verdict) {
    text << std::left << std::setw(46) << quantity << std::setw(10) << unit << std::right
         << std::setw(9) << ours << std::setw(9) << paper << std::setw(9) << opensim
         << (verdict.empty() ? "" : "  ") << verdict << '\n';
  };
  line("quantity", "unit", "ours", "paper", "OpenSim", "");
  for (const AcceptanceRow& row : rows) {
    const bool published = row.published_as != PublishedAs::kNothing;
    line(row.quantity,
         row.unit,
         renderNumber(row.ours),
         renderPublished(row),
         renderNumber(row.opensim),
         !published ? "" : (row.isMet() ? "met" : "MISSED"));
  }
  return text.str();
}

}  // namespace gaitmill
