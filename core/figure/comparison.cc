#include "core/figure/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/figure/job_figures.h"

namespace gaitmill {

namespace {

using Json = nlohmann::json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr ResultSource::Axis kCycle = ResultSource::Axis::kCycle;

/// Tables that are compared, in the order of the stages; results of a job are these and bars.
constexpr const char* kTables[] = {"kinematics",
                                   "marker_errors",
                                   "ground_reactions",
                                   "moments",
                                   "joint_powers",
                                   "activations",
                                   "excitations",
                                   "forces",
                                   "fiber_lengths",
                                   "fiber_velocities",
                                   "norm_fiber_lengths",
                                   "norm_fiber_velocities",
                                   "pennation_angles",
                                   "active_fiber_forces",
                                   "passive_fiber_forces",
                                   "muscle_moments",
                                   "fiber_active_powers",
                                   "fiber_passive_powers",
                                   "tendon_powers",
                                   "muscle_powers",
                                   "joint_reactions",
                                   "residuals",
                                   "reserves",
                                   "emg"};

/// The value of largest size; NaN if there is no number.
double findPeak(const Eigen::Ref<const Eigen::VectorXd>& values) {
  double peak = kNaN;
  for (const double value : values) {
    if (std::isfinite(value) && !(std::abs(value) <= std::abs(peak))) {
      peak = value;
    }
  }
  return peak;
}

ColumnDifference calcDifference(const Eigen::VectorXd& first,
                                const Eigen::VectorXd& other,
                                const std::vector<double>& percents) {
  ColumnDifference difference{kNaN, kNaN, kNaN, findPeak(other)};
  double squares = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < std::min(first.size(), other.size()); ++i) {
    const double value = other[i] - first[i];
    if (!std::isfinite(value)) {
      continue;
    }
    squares += value * value;
    ++count;
    if (!(std::abs(value) <= std::abs(difference.largest))) {
      difference.largest = value;
      difference.largest_percent = percents[static_cast<std::size_t>(i)];
    }
  }
  difference.rms = count > 0 ? std::sqrt(squares / count) : kNaN;
  return difference;
}

std::optional<ColumnComparison> compareColumn(const std::vector<const TimeSeries*>& tables,
                                              int column) {
  const TimeSeries& first = *tables.front();
  const auto index = static_cast<std::size_t>(column);
  const Eigen::VectorXd reference = first.values.col(column);
  ColumnComparison comparison{
      first.labels[index], first.units.empty() ? "" : first.units[index], findPeak(reference), {}};
  for (std::size_t i = 1; i < tables.size(); ++i) {
    const std::optional<int> same = tables[i]->findColumn(comparison.column);
    if (!same) {
      return std::nullopt;
    }
    comparison.differences.push_back(
        calcDifference(reference, tables[i]->values.col(*same), first.time));
  }
  return comparison;
}

TableComparison compareTable(const std::vector<NamedResult>& results, const std::string& name) {
  std::vector<const TimeSeries*> tables;
  for (const NamedResult& result : results) {
    tables.push_back(&result.results->table(name, kCycle));
  }
  TableComparison comparison{name, {}};
  for (int column = 0; column < tables.front()->columnCount(); ++column) {
    if (std::optional<ColumnComparison> one = compareColumn(tables, column)) {
      comparison.columns.push_back(std::move(*one));
    }
  }
  return comparison;
}

// Lists hold checks and the like, whose entries another job may have in another order.
void collectNumbers(const Json& value, const std::string& path, Json& numbers) {
  if (value.is_number()) {
    numbers[path] = value;
  } else if (value.is_object()) {
    for (const auto& [key, child] : value.items()) {
      collectNumbers(child, path.empty() ? key : path + "." + key, numbers);
    }
  }
}

Json findQuality(const ResultSource& results) {
  Json numbers = Json::object();
  const Json summary = Json::parse(results.summary(), nullptr, false);
  check(!summary.is_discarded(), "the summary of a job is not JSON");
  if (summary.is_object() && summary.contains("quality")) {
    collectNumbers(summary["quality"], "", numbers);
  }
  return numbers;
}

std::vector<QuantityComparison> compareQuality(const std::vector<NamedResult>& results) {
  std::vector<Json> qualities;
  Json names = Json::object();
  for (const NamedResult& result : results) {
    qualities.push_back(findQuality(*result.results));
    names.update(qualities.back());
  }
  std::vector<QuantityComparison> comparisons;
  for (const auto& [name, ignored] : names.items()) {
    QuantityComparison comparison{name, {}};
    for (const Json& quality : qualities) {
      comparison.values.push_back(quality.contains(name) ? quality[name].get<double>() : kNaN);
    }
    comparisons.push_back(std::move(comparison));
  }
  return comparisons;
}

Panel& findPanel(const Panel& like, Figure& figure) {
  for (Panel& panel : figure.panels) {
    if (panel.name == like.name) {
      return panel;
    }
  }
  Panel panel = like;
  panel.series.clear();
  panel.guides.clear();
  panel.note.clear();
  return figure.panels.emplace_back(std::move(panel));
}

void addJob(const Figure& single, const std::string& label, int group, Figure& overlay) {
  for (const Panel& panel : single.panels) {
    Panel& target = findPanel(panel, overlay);
    const bool is_alone = panel.series.size() == 1;
    for (Series series : panel.series) {
      if (series.mark == SeriesMark::kBand) {
        continue;
      }
      series.name = is_alone ? label : label + ", " + series.name;
      series.group = group;
      target.series.push_back(std::move(series));
    }
    // Toe-off and thresholds of several jobs would hide the curves: the first job's stand.
    if (group == 0) {
      target.guides = panel.guides;
    }
  }
}

}  // namespace

Comparison compareResults(const std::vector<NamedResult>& results) {
  require(results.size() >= 2, ErrorCode::kInputValue, "a comparison needs at least two jobs");
  Comparison comparison;
  for (const NamedResult& result : results) {
    comparison.labels.push_back(result.label);
  }
  for (const char* name : kTables) {
    const bool all = std::all_of(results.begin(), results.end(), [&](const NamedResult& result) {
      return result.results->has(name, kCycle);
    });
    if (all) {
      comparison.tables.push_back(compareTable(results, name));
    }
  }
  comparison.quality = compareQuality(results);
  return comparison;
}

std::vector<FigureInfo> listCommonFigures(const std::vector<NamedResult>& results) {
  std::vector<FigureInfo> common;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::vector<FigureInfo> figures = listFigures(*results[i].results);
    if (i == 0) {
      common = figures;
      continue;
    }
    const auto isMissing = [&](const FigureInfo& info) {
      return std::none_of(figures.begin(), figures.end(), [&](const FigureInfo& other) {
        return other.name == info.name;
      });
    };
    common.erase(std::remove_if(common.begin(), common.end(), isMissing), common.end());
  }
  return common;
}

Figure overlayFigures(const std::vector<NamedResult>& results, const std::string& name) {
  require(!results.empty(), ErrorCode::kInputValue, "an overlay needs at least one job");
  Figure overlay;
  for (std::size_t i = 0; i < results.size(); ++i) {
    try {
      const Figure single = makeFigure(*results[i].results, name);
      if (i == 0) {
        overlay = {single.name, single.title, single.caption, single.columns, {}};
      }
      addJob(single, results[i].label, static_cast<int>(i), overlay);
    } catch (Error& error) {
      error.addContext("job " + results[i].label);
      throw;
    }
  }
  return overlay;
}

}  // namespace gaitmill
