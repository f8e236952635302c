#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/data/figure.h"
#include "core/data/time_series.h"
#include "core/figure/muscle_names.h"
#include "core/figure/result_source.h"
#include "core/math/events.h"

namespace gaitmill {

/// How one column becomes a curve: y = factor * value.
struct Curve {
  std::string name;
  SeriesRole role = SeriesRole::kPlain;
  double factor = 1;
};

/// Columns of one quantity of both legs, or of the trunk.
struct SidedColumns {
  std::string base;   ///< name without the side
  std::string right;  ///< column names; empty = there is none
  std::string left;
  std::string center;
};

/// Columns by their name without side, in the order of their first occurrence.
std::vector<SidedColumns> pairSides(const std::vector<std::string>& labels);

/// A table without columns at these times.
TimeSeries makeEmptyTable(const TimeSeries& like);
/// Puts a column at the end. @throws kInternal if it has another length than the table
void addColumn(const std::string& label, const Eigen::VectorXd& values, TimeSeries& table);

/// The results of one job as figures need them: tables, what the summary says about the person and
/// the gait cycle, and curves over the cycle (each side over its own) or, where there is none, over
/// time.
class JobData {
 public:
  /// Keeps a reference. @throws Error kInternal if the summary is not JSON
  explicit JobData(const ResultSource& source);
  ~JobData();

  bool has(const std::string& table) const;
  bool has(const std::string& table, const std::string& column) const;
  /// Over time. @throws Error kResultNotFound, kResultNotReady
  const TimeSeries& table(const std::string& name) const;
  const nlohmann::json& summary() const { return *summary_; }

  bool hasCycle() const { return right_.main.has_value(); }
  /// "Gait cycle [%]" or "Time [s]".
  Axis makeXAxis() const;
  /// What is to be said of the axis below every figure; of the right leg's or of both.
  std::string describeAxis(bool has_left = true) const;
  /// Body weight [N]; empty if the summary does not say.
  std::optional<double> findBodyWeight() const;

  /// Adds the curve of a column to a panel; of several cycles that the table covers, the mean and
  /// its band of one standard deviation. A table without the column adds nothing.
  void addCurve(const TimeSeries& table,
                const std::string& column,
                Side side,
                const Curve& curve,
                Panel& panel) const;
  /// Right, left and centre of a quantity in one panel, each in its role.
  void addSides(const TimeSeries& table,
                const SidedColumns& columns,
                double factor,
                Panel& panel) const;
  /// Marks the toe-offs of the sides.
  void addToeOffs(bool right, bool left, Panel& panel) const;
  /// Toe-offs of the sides of the panel's series.
  void addToeOffs(Panel& panel) const;

 private:
  struct SideCycles {
    std::vector<GaitCycle> all;     ///< strike to strike, in time order
    std::optional<GaitCycle> main;  ///< the one that is shown if the table covers less than two
    std::vector<double> toe_offs;   ///< [s]
    bool is_assumed = false;        ///< its length is the other side's
  };

  void readCycles();
  void readEvents();
  const SideCycles& cyclesOf(Side side) const;
  std::vector<GaitCycle> findCovered(const TimeSeries& table, Side side) const;
  void addMean(const std::vector<std::vector<double>>& cycles,
               const Curve& curve,
               Panel& panel) const;
  /// NaN if it is not known.
  double findToeOffPercent(Side side) const;

  const ResultSource& source_;
  std::unique_ptr<nlohmann::json> summary_;
  SideCycles right_;
  SideCycles left_;
};

}  // namespace gaitmill
