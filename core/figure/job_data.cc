#include "core/figure/job_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/analysis/gait_cycle.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

using Json = nlohmann::json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTimeTolerance = 1e-6;  // [s]
// Curves over time are drawn with fewer points than pixels; more is not seen.
constexpr int kPointsOverTime = 400;

const Json& findMember(const Json& object, const char* name) {
  static const Json nothing;
  return object.is_object() && object.contains(name) ? object.at(name) : nothing;
}

std::vector<GaitCycle> readCycleList(const Json& list) {
  std::vector<GaitCycle> cycles;
  for (const Json& pair : list) {
    if (pair.is_array() && pair.size() == 2 && pair[0].is_number() && pair[1].is_number()) {
      cycles.push_back({pair[0].get<double>(), pair[1].get<double>()});
    }
  }
  return cycles;
}

TimeSeries pickColumn(const TimeSeries& table, int column) {
  TimeSeries one;
  one.labels = {table.labels[static_cast<std::size_t>(column)]};
  one.time = table.time;
  one.values = table.values.col(column);
  return one;
}

std::vector<double> toVector(const TimeSeries& one, double factor) {
  std::vector<double> values;
  values.reserve(one.time.size());
  for (int row = 0; row < one.rowCount(); ++row) {
    values.push_back(factor * one.values(row, 0));
  }
  return values;
}

Series makeSeries(const Curve& curve, SeriesMark mark) {
  Series series;
  series.name = curve.name;
  series.role = curve.role;
  series.mark = mark;
  return series;
}

void addOverTime(const TimeSeries& one, const Curve& curve, Panel& panel) {
  Series series = makeSeries(curve, SeriesMark::kLine);
  const double spacing = (one.time.back() - one.time.front()) / kPointsOverTime;
  double next = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < one.rowCount(); ++row) {
    const double time = one.time[static_cast<std::size_t>(row)];
    if (time >= next || row == one.rowCount() - 1) {
      series.x.push_back(time);
      series.y.push_back(curve.factor * one.values(row, 0));
      next = time + spacing * (1 - 1e-9);
    }
  }
  panel.series.push_back(std::move(series));
}

std::vector<double> makePercents() {
  std::vector<double> percents;
  for (int i = 0; i <= 100; ++i) {
    percents.push_back(i);
  }
  return percents;
}

}  // namespace

std::vector<SidedColumns> pairSides(const std::vector<std::string>& labels) {
  std::vector<SidedColumns> pairs;
  for (const std::string& label : labels) {
    const SidedName name = splitSide(label);
    const auto known = std::find_if(pairs.begin(), pairs.end(), [&](const SidedColumns& pair) {
      return pair.base == name.base;
    });
    SidedColumns& pair =
        known != pairs.end() ? *known : pairs.emplace_back(SidedColumns{name.base, "", "", ""});
    (name.side == Side::kRight  ? pair.right
     : name.side == Side::kLeft ? pair.left
                                : pair.center) = label;
  }
  return pairs;
}

TimeSeries makeEmptyTable(const TimeSeries& like) {
  TimeSeries table;
  table.time = like.time;
  table.values.resize(like.rowCount(), 0);
  return table;
}

void addColumn(const std::string& label, const Eigen::VectorXd& values, TimeSeries& table) {
  check(values.size() == table.rowCount(), "a column of a figure has another length");
  table.labels.push_back(label);
  table.values.conservativeResize(table.rowCount(), table.columnCount());
  table.values.col(table.columnCount() - 1) = values;
}

JobData::JobData(const ResultSource& source)
    : source_(source),
      summary_(std::make_unique<Json>(Json::parse(source.summary(), nullptr, false))) {
  check(!summary_->is_discarded(), "the summary of a job is not JSON");
  readEvents();
  readCycles();
}

JobData::~JobData() = default;

void JobData::readEvents() {
  for (const Json& event : findMember(*summary_, "events")) {
    const Json& time = findMember(event, "time_s");
    if (time.is_number() && event.value("kind", "") == "toe_off") {
      (event.value("foot", "") == "left" ? left_ : right_).toe_offs.push_back(time.get<double>());
    }
  }
}

void JobData::readCycles() {
  const Json& cycles = findMember(*summary_, "cycles");
  right_.all = readCycleList(findMember(cycles, "right"));
  left_.all = readCycleList(findMember(cycles, "left"));
  const std::vector<GaitCycle> chosen =
      readCycleList(Json::array({findMember(*summary_, "gait_cycle_s")}));
  if (!chosen.empty() || !right_.all.empty()) {
    right_.main = chosen.empty() ? right_.all.front() : chosen.front();
  }
  if (!left_.all.empty()) {
    left_.main = left_.all.front();
    return;
  }
  for (const Json& event : findMember(*summary_, "events")) {
    const Json& time = findMember(event, "time_s");
    const bool is_left_strike = event.value("kind", "") == "foot_strike" &&
                                event.value("foot", "") == "left" && time.is_number();
    if (is_left_strike && right_.main && !left_.main) {
      const double start = time.get<double>();
      left_.main = GaitCycle{start, start + right_.main->end - right_.main->start};
      left_.is_assumed = true;
    }
  }
}

const JobData::SideCycles& JobData::cyclesOf(Side side) const {
  return side == Side::kLeft && left_.main ? left_ : right_;
}

bool JobData::has(const std::string& name) const {
  return source_.has(name, ResultSource::Axis::kTime);
}

bool JobData::has(const std::string& name, const std::string& column) const {
  return has(name) && (column.empty() || table(name).findColumn(column).has_value());
}

const TimeSeries& JobData::table(const std::string& name) const {
  return source_.table(name, ResultSource::Axis::kTime);
}

Axis JobData::makeXAxis() const {
  return hasCycle() ? Axis{"Gait cycle", "%", 0.0, 100.0} : Axis{"Time", "s"};
}

std::string JobData::describeAxis(bool has_left) const {
  if (!hasCycle()) {
    return "Over time, because the forces show no whole gait cycle.";
  }
  std::string sentence = "From right foot strike to right foot strike";
  if (has_left && left_.is_assumed) {
    sentence += ", left curves from left foot strike, for as long as the right cycle lasts";
  } else if (has_left && left_.main) {
    sentence += ", left curves from left to left";
  }
  sentence += "; what a record does not cover comes from the cycle before or after.";
  if (right_.all.size() > 1) {
    sentence += " Where a record covers several cycles: mean and standard deviation.";
  }
  return sentence;
}

std::optional<double> JobData::findBodyWeight() const {
  const Json& mass = findMember(findMember(*summary_, "subject"), "mass_kg");
  return mass.is_number() ? std::optional<double>(kGravity * mass.get<double>()) : std::nullopt;
}

std::vector<GaitCycle> JobData::findCovered(const TimeSeries& table, Side side) const {
  std::vector<GaitCycle> covered;
  for (const GaitCycle& cycle : cyclesOf(side).all) {
    if (table.time.front() <= cycle.start + kTimeTolerance &&
        table.time.back() >= cycle.end - kTimeTolerance) {
      covered.push_back(cycle);
    }
  }
  return covered;
}

void JobData::addCurve(const TimeSeries& table,
                       const std::string& column,
                       Side side,
                       const Curve& curve,
                       Panel& panel) const {
  const std::optional<int> index = table.findColumn(column);
  if (!index || table.rowCount() == 0) {
    return;
  }
  const TimeSeries one = pickColumn(table, *index);
  if (!hasCycle()) {
    return addOverTime(one, curve, panel);
  }
  const std::vector<GaitCycle> covered = findCovered(one, side);
  std::vector<std::vector<double>> cycles;
  for (const GaitCycle& cycle : covered) {
    cycles.push_back(toVector(normalizeToCycle(one, cycle), curve.factor));
  }
  if (cycles.size() < 2) {
    cycles = {toVector(normalizeToCycle(one, *cyclesOf(side).main), curve.factor)};
  }
  addMean(cycles, curve, panel);
}

void JobData::addMean(const std::vector<std::vector<double>>& cycles,
                      const Curve& curve,
                      Panel& panel) const {
  Series band = makeSeries(curve, SeriesMark::kBand);
  Series line = makeSeries(curve, SeriesMark::kLine);
  line.x = makePercents();
  const double count = static_cast<double>(cycles.size());
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    double sum = 0;
    double squares = 0;
    for (const std::vector<double>& cycle : cycles) {
      sum += cycle[i];
    }
    const double mean = sum / count;
    for (const std::vector<double>& cycle : cycles) {
      squares += (cycle[i] - mean) * (cycle[i] - mean);
    }
    const double deviation = std::sqrt(squares / std::max(1.0, count - 1));
    line.y.push_back(mean);
    band.y.push_back(mean + deviation);
    band.low.push_back(mean - deviation);
  }
  if (cycles.size() > 1) {
    band.x = line.x;
    panel.series.push_back(std::move(band));
  }
  panel.series.push_back(std::move(line));
}

void JobData::addSides(const TimeSeries& table,
                       const SidedColumns& columns,
                       double factor,
                       Panel& panel) const {
  addCurve(table, columns.center, Side::kNone, {"trunk", SeriesRole::kReference, factor}, panel);
  addCurve(table, columns.right, Side::kRight, {"right", SeriesRole::kRight, factor}, panel);
  addCurve(table, columns.left, Side::kLeft, {"left", SeriesRole::kLeft, factor}, panel);
}

double JobData::findToeOffPercent(Side side) const {
  const SideCycles& cycles = side == Side::kLeft ? left_ : right_;
  double moved = kNaN;
  for (const double toe_off : cycles.main ? cycles.toe_offs : std::vector<double>{}) {
    const double percent = calcPercent(*cycles.main, toe_off);
    if (percent > 0 && percent < 100) {
      return percent;
    }
    moved = std::isnan(moved) ? percent - 100 * std::floor(percent / 100) : moved;
  }
  return moved;
}

void JobData::addToeOffs(bool right, bool left, Panel& panel) const {
  constexpr double kAlike = 1;  // [%] drawn as one line
  const auto add = [&](double place, const char* label) {
    panel.guides.push_back({Guide::Direction::kVertical, place, label});
  };
  if (!hasCycle()) {
    for (const double time : right_.toe_offs) {
      add(time, "right toe-off");
    }
    return;
  }
  const double right_percent = right ? findToeOffPercent(Side::kRight) : kNaN;
  const double left_percent = left ? findToeOffPercent(Side::kLeft) : kNaN;
  const bool alike = std::abs(right_percent - left_percent) < kAlike;
  if (!std::isnan(right_percent)) {
    add(right_percent, alike || !left ? "toe-off" : "right toe-off");
  }
  if (!std::isnan(left_percent) && !alike) {
    add(left_percent, right ? "left toe-off" : "toe-off");
  }
}

void JobData::addToeOffs(Panel& panel) const {
  const auto isOf = [&](SeriesRole role) {
    return std::any_of(panel.series.begin(), panel.series.end(), [&](const Series& series) {
      return series.role == role;
    });
  };
  const bool left = isOf(SeriesRole::kLeft);
  addToeOffs(isOf(SeriesRole::kRight) || !left, left, panel);
}

}  // namespace gaitmill
