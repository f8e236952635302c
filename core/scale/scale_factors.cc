#include "core/scale/scale_factors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/where.h"

namespace gaitmill {

namespace {

/// Where model distances are taken.
struct Stand {
  const Model& model;
  ModelState state;
  double factor = 1;  ///< that the distances have already
};

std::optional<Eigen::Vector3d> findInModel(const Model& model,
                                           const ModelState& state,
                                           const std::string& name) {
  const int index = model.spec().findMarker(name);
  if (index < 0) {
    return std::nullopt;
  }
  const MarkerSpec& marker = model.spec().markers[static_cast<std::size_t>(index)];
  return state.pose(model.getBody(marker.body)) * marker.location;
}

/// Measures one pair; returns what is wrong, or nothing.
std::string measure(const Stand& stand,
                    const MarkerTrajectories& trial,
                    const ScaleOptions& options,
                    PairResult& pair) {
  const Model& model = stand.model;
  for (const std::string& name : {pair.first, pair.second}) {
    if (!trial.findMarker(name)) {
      return "marker '" + name + "' is not in the static trial";
    }
    if (model.spec().findMarker(name) < 0) {
      return "marker '" + name + "' is not in the model";
    }
  }
  const int a = *trial.findMarker(pair.first);
  const int b = *trial.findMarker(pair.second);
  const FrameRange rows = findFrameRange(trial.time, options.marker_set.measurement_range);
  double sum = 0;
  int visible = 0;
  for (int row = rows.first; row <= rows.last; ++row) {
    const double distance = (trial.position(row, a) - trial.position(row, b)).norm();
    visible += std::isfinite(distance) ? 1 : 0;
    sum += std::isfinite(distance) ? distance : 0.0;
  }
  pair.visible_fraction = static_cast<double>(visible) / (rows.last - rows.first + 1);
  if (visible == 0 || pair.visible_fraction < options.min_visible_fraction) {
    return "markers '" + pair.first + "' and '" + pair.second +
           "' are visible together in too few frames";
  }
  pair.measured = sum / visible;
  const Eigen::Vector3d first = *findInModel(model, stand.state, pair.first);
  const Eigen::Vector3d second = *findInModel(model, stand.state, pair.second);
  pair.in_model = (first - second).norm() / stand.factor;
  if (pair.in_model <= 0) {
    return "markers '" + pair.first + "' and '" + pair.second + "' coincide in the model";
  }
  pair.factor = pair.measured / pair.in_model;
  return {};
}

/// The pairs of one measurement and the mean of their factors.
MeasurementResult measurePairs(const Stand& stand,
                               const MarkerTrajectories& trial,
                               const ScaleOptions& options,
                               const MeasurementSpec& spec,
                               std::vector<std::string>& warnings) {
  MeasurementResult result{spec.name, -1, {}, MeasurementUse::kUnmeasured};
  double sum = 0;
  int count = 0;
  for (const MarkerPair& names : spec.pairs) {
    PairResult pair{names.first, names.second};
    const std::string fault = measure(stand, trial, options, pair);
    require(fault.empty() || !spec.required,
            ErrorCode::kInputMarkers,
            "measurement '" + spec.name + "': " + fault,
            atMarker(names.first));
    if (!fault.empty()) {
      warnings.push_back("measurement '" + spec.name + "' leaves a pair out: " + fault);
    }
    sum += fault.empty() ? pair.factor : 0.0;
    count += fault.empty() ? 1 : 0;
    result.pairs.push_back(std::move(pair));
  }
  if (count > 0) {
    result.factor = sum / count;
    result.use = MeasurementUse::kApplied;
  }
  return result;
}

bool isApplied(const MeasurementResult& result) {
  return result.use == MeasurementUse::kApplied || result.use == MeasurementUse::kLimited;
}

std::string listPairs(const MeasurementResult& result) {
  std::string list;
  for (const PairResult& pair : result.pairs) {
    if (pair.factor > 0) {
      list += (list.empty() ? "" : ", ") + pair.first + " to " + pair.second + " " +
              formatFixed(100 * pair.measured, 1) + " cm against " +
              formatFixed(100 * pair.in_model, 1) + " cm in the model";
    }
  }
  return list;
}

/// Refuses a factor outside the band of its measurement.
void judgeBand(const MeasurementSpec& spec,
               MeasurementResult& result,
               std::vector<std::string>& warnings) {
  if (isApplied(result) && (result.factor < spec.min_factor || result.factor > spec.max_factor)) {
    result.use = MeasurementUse::kRefused;
    warnings.push_back("measurement '" + spec.name + "' is refused: its factor " +
                       formatFixed(result.factor, 3) + " lies outside " +
                       formatFixed(spec.min_factor, 2) + " to " + formatFixed(spec.max_factor, 2) +
                       " (" + listPairs(result) +
                       "); are these markers swapped, misnamed or misplaced?");
  }
}

/// Keeps a factor within its limits relative to an earlier measurement.
void applyLimit(const MarkerSetSpec& set,
                const std::vector<MeasurementResult>& earlier,
                MeasurementResult& result,
                std::vector<std::string>& warnings) {
  const std::optional<FactorLimit>& limit = set.measurements[earlier.size()].limit;
  if (!limit || !isApplied(result)) {
    return;
  }
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    const bool is_named = earlier[i].name == limit->measurement ||
                          set.measurements[i].alternative_of == limit->measurement;
    if (!is_named || !isApplied(earlier[i])) {
      continue;
    }
    const double limited = std::clamp(
        result.factor, limit->min_ratio * earlier[i].factor, limit->max_ratio * earlier[i].factor);
    if (limited != result.factor) {
      warnings.push_back("measurement '" + result.name + "' gives " +
                         formatFixed(result.factor, 3) + "; limited to " + formatFixed(limited, 3) +
                         " beside '" + earlier[i].name + "' " + formatFixed(earlier[i].factor, 3));
      result.factor = limited;
      result.use = MeasurementUse::kLimited;
    }
    return;
  }
}

BodyScale& getScale(const Model& model, const std::string& body, ScaleFactors& factors) {
  return factors.bodies[static_cast<std::size_t>(model.getBody(body).value())];
}

// Pairs that disagree mean a misplaced marker, or two sides that differ.
void warnOfDisagreement(const ScaleOptions& options,
                        const MeasurementResult& result,
                        std::vector<std::string>& warnings) {
  const PairResult* smallest = nullptr;
  const PairResult* largest = nullptr;
  for (const PairResult& pair : result.pairs) {
    if (pair.factor > 0) {
      smallest = smallest == nullptr || pair.factor < smallest->factor ? &pair : smallest;
      largest = largest == nullptr || pair.factor > largest->factor ? &pair : largest;
    }
  }
  if (smallest != nullptr && largest->factor > options.warn_pair_ratio * smallest->factor) {
    warnings.push_back("measurement '" + result.name + "': " + largest->first + " to " +
                       largest->second + " asks for a factor of " +
                       std::to_string(largest->factor) + ", " + smallest->first + " to " +
                       smallest->second + " for " + std::to_string(smallest->factor));
  }
}

void applyFactor(const Model& model,
                 const MeasurementSpec& spec,
                 double factor,
                 ScaleFactors& factors) {
  for (const std::string& body : spec.bodies) {
    BodyScale& scale = getScale(model, body, factors);
    for (int axis = 0; axis < 3; ++axis) {
      if (spec.axes[static_cast<std::size_t>(axis)]) {
        scale.factors[axis] = factor;
      }
    }
  }
}

/// Whether an earlier alternative already counts.
bool isAnswered(const MarkerSetSpec& set, std::size_t index, const ScaleFactors& factors) {
  const std::string& group = set.measurements[index].alternative_of;
  for (std::size_t i = 0; i < index && !group.empty(); ++i) {
    if (set.measurements[i].alternative_of == group && isApplied(factors.measurements[i])) {
      return true;
    }
  }
  return false;
}

/// The factor that a measurement's bodies have.
double findFactor(const Model& model,
                  const MeasurementSpec& spec,
                  const std::vector<BodyScale>& factors) {
  for (const std::string& body : spec.bodies) {
    for (int axis = 0; axis < 3; ++axis) {
      if (spec.axes[static_cast<std::size_t>(axis)]) {
        return factors[static_cast<std::size_t>(model.getBody(body).value())].factors[axis];
      }
    }
  }
  return 1.0;
}

void applyMeasurements(const Model& model,
                       const MarkerTrajectories& trial,
                       const ScaleOptions& options,
                       const FittedModel* fitted,
                       ScaleFactors& factors) {
  Stand generic{model, ModelState(model)};
  generic.state.setPose(model.defaultPose());
  const Model& fitted_model = fitted != nullptr ? fitted->model : model;
  Stand standing{fitted_model, ModelState(fitted_model)};
  standing.state.setPose(fitted != nullptr ? fitted->q : model.defaultPose());
  const MarkerSetSpec& set = options.marker_set;
  for (std::size_t i = 0; i < set.measurements.size(); ++i) {
    const MeasurementSpec& spec = set.measurements[i];
    if (isAnswered(set, i, factors)) {
      factors.measurements.push_back({spec.name, -1, {}, MeasurementUse::kNotNeeded});
      continue;
    }
    standing.factor = fitted != nullptr ? findFactor(model, spec, fitted->factors) : 1.0;
    MeasurementResult result = measurePairs(
        spec.in_fitted_pose ? standing : generic, trial, options, spec, factors.warnings);
    judgeBand(spec, result, factors.warnings);
    applyLimit(set, factors.measurements, result, factors.warnings);
    for (const std::string& body : spec.bodies) {
      getScale(model, body, factors);
    }
    if (isApplied(result)) {
      applyFactor(model, spec, result.factor, factors);
    }
    warnOfDisagreement(options, result, factors.warnings);
    factors.measurements.push_back(std::move(result));
  }
}

void applyManual(const Model& model, const MarkerSetSpec& set, ScaleFactors& factors) {
  for (const ManualScaleSpec& manual : set.manual) {
    for (const std::string& body : manual.bodies) {
      getScale(model, body, factors).factors = manual.factors;
    }
  }
}

void warnOfUnusualFactors(const ScaleOptions& options, ScaleFactors& factors) {
  for (const BodyScale& scale : factors.bodies) {
    if (scale.factors.minCoeff() < options.warn_factor_min ||
        scale.factors.maxCoeff() > options.warn_factor_max) {
      factors.warnings.push_back("body '" + scale.body + "' is scaled by " +
                                 std::to_string(scale.factors.x()) + ", " +
                                 std::to_string(scale.factors.y()) + ", " +
                                 std::to_string(scale.factors.z()) + ", which is unusual");
    }
  }
}

/// Nothing keeps its size in silence.
void warnOfUnmeasuredBodies(const MarkerSetSpec& set, ScaleFactors& factors) {
  std::set<std::string> measured;
  for (std::size_t i = 0; i < set.measurements.size(); ++i) {
    if (isApplied(factors.measurements[i])) {
      measured.insert(set.measurements[i].bodies.begin(), set.measurements[i].bodies.end());
    }
  }
  for (const ManualScaleSpec& manual : set.manual) {
    measured.insert(manual.bodies.begin(), manual.bodies.end());
  }
  std::string list;
  for (const BodyScale& body : factors.bodies) {
    if (measured.count(body.body) == 0) {
      list += (list.empty() ? "" : ", ") + body.body;
    }
  }
  if (!list.empty() && !(set.measurements.empty() && set.manual.empty())) {
    factors.warnings.push_back(
        "nothing measures " + list + ": scaled by " + formatFixed(set.size_ratio, 3) +
        (set.size_ratio == 1 ? ", the generic size" : ", the subject's height over the model's"));
  }
}

}  // namespace

FrameRange findFrameRange(const std::vector<double>& time, const TimeRange& range) {
  require(!time.empty() && range.start <= time.back() && range.end >= time.front(),
          ErrorCode::kInputTimeRange,
          "no frame of the static trial lies in the time range",
          {{}, 0, 0, "time_range_s"});
  const auto after_start = std::upper_bound(time.begin(), time.end(), range.start);
  const auto at_end = std::lower_bound(time.begin(), time.end(), range.end);
  const int count = static_cast<int>(time.size());
  return {std::max(0, static_cast<int>(std::distance(time.begin(), after_start)) - 1),
          std::min(count - 1, static_cast<int>(std::distance(time.begin(), at_end)))};
}

ScaleFactors calcScaleFactors(const Model& model,
                              const MarkerTrajectories& trial,
                              const ScaleOptions& options,
                              const FittedModel* fitted) {
  ScaleFactors factors;
  for (const BodySpec& body : model.spec().bodies) {
    factors.bodies.push_back({body.name, Eigen::Vector3d::Constant(options.marker_set.size_ratio)});
  }
  if (options.marker_set.order == ScalingOrder::kManualThenMeasurements) {
    applyManual(model, options.marker_set, factors);
    applyMeasurements(model, trial, options, fitted, factors);
  } else {
    applyMeasurements(model, trial, options, fitted, factors);
    applyManual(model, options.marker_set, factors);
  }
  warnOfUnusualFactors(options, factors);
  warnOfUnmeasuredBodies(options.marker_set, factors);
  return factors;
}

}  // namespace gaitmill
