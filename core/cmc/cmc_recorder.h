#pragma once

#include <array>
#include <vector>

#include "core/cmc/cmc_controller.h"
#include "core/cmc/cmc_result.h"
#include "core/cmc/cmc_state.h"
#include "core/cmc/forward_integrator.h"
#include "core/cmc/musculoskeleton.h"
#include "core/model/model.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// Fills the tables of a CmcResult row by row. Sized for the whole run in the constructor.
class CmcRecorder {
 public:
  /// Keeps references to `model` and `muscles`.
  /// @param max_rows, max_windows  rows of the tables at most
  CmcRecorder(const Model& model,
              const std::vector<Muscle>& muscles,
              const Musculoskeleton& body,
              int max_rows,
              int max_windows);

  /// A row at `state`, at which `integrator` was evaluated and `body` still is.
  void addRow(const CmcState& state,
              const Eigen::VectorXd& excitation,
              const ForwardIntegrator& integrator,
              const Musculoskeleton& body);
  void addTrackingError(double time, const Eigen::VectorXd& error);
  /// Notes a window whose demand was not met.
  void addInfeasible(const CmcWindow& window);

  /// The tables without unused rows.
  CmcResult take();

 private:
  /// The tables with one row per integration step.
  std::array<TimeSeries*, 11> findRowTables();

  const Model& model_;
  const std::vector<Muscle>& muscles_;
  std::vector<std::string> free_names_;
  CmcResult result_;
  int rows_ = 0;
  int errors_ = 0;
};

}  // namespace gaitmill
