#pragma once

#include <string>
#include <vector>

#include "core/analysis/actuator_statistics.h"
#include "core/analysis/moment_comparison.h"
#include "core/analysis/tracking_error.h"

namespace gaitmill {

/// The two trials of Rajagopal et al. (2016), IEEE Trans Biomed Eng 63:2068.
enum class PaperTrial { kWalk, kRun };

/// How a published figure is to be read.
enum class PublishedAs {
  kNothing,  ///< the paper gives no figure
  kBound,    ///< "less than": ours must stay below
  kValue,    ///< what the paper measured: ours may differ within a factor of two
};

/// One line of the acceptance list: ours, the paper's and OpenSim's figure for the same quantity.
struct AcceptanceRow {
  std::string quantity;  ///< "CMC tracking, largest RMS rotation"
  std::string unit;
  double ours;
  double paper;    ///< NaN if the paper gives none
  double opensim;  ///< OpenSim 4.6 on the same files and set-ups; NaN if not known
  PublishedAs published_as = PublishedAs::kNothing;

  /// Below the bound, or below twice the published value. True where nothing is published.
  bool isMet() const;
};

/// What the list is made from. Moments in the order of paperMoments().
struct AcceptanceInput {
  TrackingError rra;
  TrackingError cmc;
  std::vector<MomentComparison> moments;
  std::vector<ActuatorStatistics> residuals;  ///< FX FY FZ MX MY MZ
  std::vector<ActuatorStatistics> reserves;
};

/// The acceptance list of spec/paper_metrics.md A to C for one trial, and the residuals.
std::vector<AcceptanceRow> makeAcceptanceTable(PaperTrial trial, const AcceptanceInput& input);

/// The list as aligned text, one line per row: quantity, ours, paper, OpenSim, verdict.
std::string renderAcceptanceTable(const std::vector<AcceptanceRow>& rows);

}  // namespace gaitmill
