#include "core/scale/motion_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/model/marker_fit.h"
#include "core/model/pose_search.h"
#include "core/scale/apply_scale.h"
#include "core/scale/marker_placement.h"
#include "core/scale/motion_fit_program.h"
#include "core/scale/motion_frames.h"
#include "core/scale/scale_solver.h"

namespace gaitmill {

namespace {

/// Frames of the motion that are posed one by one to tell how well the model fits; a longer motion
/// is thinned out.
constexpr int kMostFrames = 600;

/// A pose is searched anew, rather than continued, where its markers are met this badly [m] and
/// this much worse than in the frame before.
constexpr double kLostRms = 0.03;
constexpr double kLostFactor = 1.5;

/// Shares of the work, for progress.
constexpr double kAfterStart = 0.15;
constexpr double kAfterFit = 0.85;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

double calcRms(const Eigen::Ref<const Eigen::VectorXd>& errors) {
  double total = 0;
  int visible = 0;
  for (const double error : errors) {
    total += std::isnan(error) ? 0 : error * error;
    visible += std::isnan(error) ? 0 : 1;
  }
  return visible > 0 ? std::sqrt(total / visible) : std::numeric_limits<double>::quiet_NaN();
}

/// Frames and their poses on one model, each fitted by itself.
struct PosedFrames {
  std::vector<Eigen::VectorXd> poses;  ///< per frame, (n_coordinates)
  double pooled_rms = -1;              ///< over all visible markers of all frames [m]
  double mean_rms = -1;                ///< mean of the frames' own [m]
};

enum class PoseStart { kSearch, kPrevious };

PosedFrames poseFrames(const Model& model,
                       MarkerFit& fit,
                       const MarkerTrajectories& trial,
                       const std::vector<int>& frames,
                       PoseStart start,
                       const Progress& progress) {
  PosedFrames posed;
  PoseSearch search(model, fit);
  Eigen::VectorXd q = model.defaultPose();
  Eigen::VectorXd all(static_cast<Eigen::Index>(frames.size() * fit.markers().size()));
  all.setConstant(std::numeric_limits<double>::quiet_NaN());
  double rms = std::numeric_limits<double>::infinity();
  double total = 0;
  int seen = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    reportProgress(progress, static_cast<double>(k) / static_cast<double>(frames.size()));
    const Eigen::Matrix3Xd measured = readMarkers(trial, fit.markers(), frames[k]);
    bool lost = start == PoseStart::kSearch || k == 0;
    if (!lost) {
      fit.solve(measured, q);
      const double before = rms;
      rms = calcRms(fit.errors());
      lost = rms > kLostRms && rms > kLostFactor * before;
    }
    if (lost) {
      search.solve(measured, q);
      rms = calcRms(fit.errors());
    }
    posed.poses.push_back(q);
    all.segment(static_cast<Eigen::Index>(k * fit.markers().size()), fit.errors().size()) =
        fit.errors();
    total += std::isnan(rms) ? 0 : rms;
    seen += std::isnan(rms) ? 0 : 1;
  }
  posed.pooled_rms = calcRms(all);
  posed.mean_rms = seen > 0 ? total / seen : -1;
  return posed;
}

Progress partOf(const Progress& whole, double from, double to) {
  if (!whole) {
    return {};
  }
  return [=](double fraction) {
    return whole(from + (to - from) * fraction);
  };
}

/// Markers that the set sizes or places a segment with, or computes such points from.
std::set<std::string> findLandmarks(const MarkerSetSpec& set) {
  std::set<std::string> landmarks;
  for (const VirtualMarkerSpec& point : set.virtual_markers) {
    landmarks.insert(point.sources.begin(), point.sources.end());
  }
  for (const MeasurementSpec& measurement : set.measurements) {
    for (const MarkerPair& pair : measurement.pairs) {
      landmarks.insert({pair.first, pair.second});
    }
  }
  for (const PlacementSpec& placement : set.placements) {
    for (const MarkerWeight& task : placement.tasks.markers) {
      if (task.weight > 0) {
        landmarks.insert(task.marker);
      }
    }
  }
  return landmarks;
}

std::vector<SizePrior> makeSizePriors(const std::vector<ScaleGroup>& groups, double expected) {
  std::vector<SizePrior> priors;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    priors.push_back(
        {groups[g].name, {static_cast<int>(g)}, {1.0}, expected, expected * groups[g].deviation});
  }
  const auto find = [&](const std::string& name) {
    const auto found = std::find_if(
        groups.begin(), groups.end(), [&](const ScaleGroup& group) { return group.name == name; });
    return static_cast<int>(std::distance(groups.begin(), found));
  };
  for (const SizePair& pair : makeSizePairs(groups)) {
    priors.push_back({pair.first + " to " + pair.second,
                      {find(pair.first), find(pair.second)},
                      {1.0, -1.0},
                      0.0,
                      expected * pair.deviation});
  }
  return priors;
}

/// One fit, from the recording to the numbers of the programme.
class MotionFit {
 public:
  MotionFit(const ModelSpec& generic,
            const ScaleOptions& options,
            const MotionScaleOptions& motion,
            const MarkerTrajectories& trial);

  void start(const Progress& progress);
  void solve(const Progress& progress);
  void finish(const Progress& progress, ScaleResult& result);

 private:
  ModelSpec makeEvenModel() const;
  void makeData(const MarkerFit& fit);
  /// @param unit  weight of a marker or coordinate task of weight 1 in one frame
  void setPoseBelief(const MarkerFit& fit, double unit);
  double findOffsetDeviation(const std::string& marker) const;
  std::vector<int> thinOut() const;
  void placeUnweighted(const MotionFitProgram& program, ScaleResult& result) const;
  void storeSizes(MotionFitResult& result) const;
  void placeMarkers(const MotionFitProgram& program, ScaleResult& result) const;
  void removeUnmeasured(ScaleResult& result) const;

  const ModelSpec& generic_;
  const ScaleOptions& options_;
  const MotionScaleOptions& motion_;
  const MarkerTrajectories& trial_;
  double expected_;  ///< height / generic height
  std::set<std::string> landmarks_;
  std::vector<int> frames_;
  MotionFitData data_;
  Eigen::VectorXd x_;
  MotionFitResult result_;
};

MotionFit::MotionFit(const ModelSpec& generic,
                     const ScaleOptions& options,
                     const MotionScaleOptions& motion,
                     const MarkerTrajectories& trial)
    : generic_(generic),
      options_(options),
      motion_(motion),
      trial_(trial),
      expected_(motion.subject_height / motion.generic_height),
      landmarks_(findLandmarks(options.marker_set)) {
  data_.groups = makeScaleGroups(generic);
}

ModelSpec MotionFit::makeEvenModel() const {
  const ModelSpec kinematic = makeKinematicModel(generic_);
  const auto n = static_cast<Eigen::Index>(data_.groups.size());
  return applyScaleFactors(
      kinematic,
      calcBodyScales(kinematic, data_.groups, Eigen::VectorXd::Constant(n, expected_)),
      MassDistribution::kPreserved);
}

double MotionFit::findOffsetDeviation(const std::string& marker) const {
  const MarkerSpec& spec = generic_.markers[at(generic_.findMarker(marker))];
  if (spec.fixed) {
    return 0;
  }
  const auto& stated = options_.marker_set.place_deviations;
  if (const auto deviation = stated.find(marker); deviation != stated.end()) {
    return deviation->second;
  }
  // A set that measures and places nothing cannot tell; its places are then all it knows.
  const bool is_landmark = landmarks_.empty() || landmarks_.count(marker) > 0;
  return is_landmark ? motion_.landmark_deviation : motion_.tracking_deviation;
}

void MotionFit::makeData(const MarkerFit& fit) {
  data_.markers = fit.markers();
  // The whole recording weighs as much as its independent frames.
  const double frame_weight =
      motion_.independent_frames / static_cast<double>(std::max<std::size_t>(1, frames_.size()));
  const double mean_weight = std::accumulate(fit.weights().begin(), fit.weights().end(), 0.0) /
                             static_cast<double>(fit.weights().size());
  const double unit =
      frame_weight / mean_weight / (motion_.marker_deviation * motion_.marker_deviation);
  for (std::size_t m = 0; m < data_.markers.size(); ++m) {
    data_.weights.push_back(unit * fit.weights()[m]);
    data_.offset_deviations.push_back(findOffsetDeviation(data_.markers[m]));
  }
  for (const int frame : frames_) {
    data_.measured.push_back(readMarkers(trial_, data_.markers, frame));
  }
  const auto n = static_cast<Eigen::Index>(data_.groups.size());
  data_.size_priors = makeSizePriors(data_.groups, expected_);
  data_.size_lower.setConstant(n, motion_.min_relative_size * expected_);
  data_.size_upper.setConstant(n, motion_.max_relative_size * expected_);
  setPoseBelief(fit, unit);
}

// Coordinates that no marker sees stay where they are; the others are pulled to their default so
// weakly that only what is next to unseen follows. Coordinate tasks weigh as in inverse kinematics.
void MotionFit::setPoseBelief(const MarkerFit& fit, double unit) {
  const FreeCoordinates& free = fit.freeCoordinates();
  const std::vector<std::string>& held = fit.heldCoordinates();
  const double weight = motion_.independent_frames / static_cast<double>(frames_.size()) /
                        (motion_.rotation_deviation * motion_.rotation_deviation);
  data_.pose_lower = fit.lowerBounds();
  data_.pose_upper = fit.upperBounds();
  data_.pose_mean.setZero(free.count());
  data_.pose_weights.setZero(free.count());
  for (const JointSpec& joint : generic_.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      const auto index =
          std::find_if(free.indices().begin(), free.indices().end(), [&](const CoordinateIndex c) {
            return fit.model().coordinate(c).name == coordinate.name;
          });
      if (index == free.indices().end()) {
        continue;
      }
      const auto f = std::distance(free.indices().begin(), index);
      data_.pose_mean[f] = coordinate.default_value;
      if (std::find(held.begin(), held.end(), coordinate.name) != held.end()) {
        data_.pose_lower[f] = coordinate.default_value;
        data_.pose_upper[f] = coordinate.default_value;
      } else if (joint.parent.body != "ground" &&
                 findMotionKind(joint, coordinate.name) != MotionKind::kTranslational) {
        data_.pose_weights[f] = weight;
      }
    }
  }
  for (const CoordinateTask& task : options_.marker_set.ik.coordinates) {
    const CoordinateIndex c = fit.model().getCoordinate(task.coordinate);
    const int f = free.findFree(c);
    if (f >= 0 && task.weight > 0) {
      const double before = data_.pose_weights[f];
      const double after = before + unit * task.weight;
      const double value = task.value.value_or(fit.model().coordinate(c).default_value);
      data_.pose_mean[f] = (before * data_.pose_mean[f] + unit * task.weight * value) / after;
      data_.pose_weights[f] = after;
    }
  }
}

std::vector<int> MotionFit::thinOut() const {
  std::vector<int> frames;
  const int n = trial_.frameCount();
  const int step = (n + kMostFrames - 1) / kMostFrames;
  for (int frame = 0; frame < n; frame += step) {
    const double time = trial_.time[at(frame)];
    if (time >= motion_.range.start && time <= motion_.range.end) {
      frames.push_back(frame);
    }
  }
  return frames;
}

void MotionFit::start(const Progress& progress) {
  const Model even(makeEvenModel());
  MarkerFit fit(even, options_.marker_set.ik, trial_.names, options_.fit);
  frames_ = chooseFrames(trial_, fit.markers(), motion_.range, motion_.frame_count);
  const PosedFrames posed =
      poseFrames(even, fit, trial_, frames_, PoseStart::kSearch, partOf(progress, 0, 0.6));
  const PosedFrames motion =
      poseFrames(even, fit, trial_, thinOut(), PoseStart::kPrevious, partOf(progress, 0.6, 1));
  result_.frames_rms_before = posed.pooled_rms;
  result_.motion_rms_before = motion.mean_rms;
  for (const int frame : frames_) {
    result_.times.push_back(trial_.time[at(frame)]);
  }
  makeData(fit);
  const int free_count = fit.freeCoordinates().count();
  const auto groups = static_cast<Eigen::Index>(data_.groups.size());
  const auto moved = std::count_if(data_.offset_deviations.begin(),
                                   data_.offset_deviations.end(),
                                   [](double deviation) { return deviation > 0; });
  x_.setZero(groups + 3 * moved + static_cast<Eigen::Index>(frames_.size()) * free_count);
  x_.head(groups).setConstant(expected_);
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const auto place = groups + 3 * moved + static_cast<Eigen::Index>(k) * free_count;
    fit.freeCoordinates().pick(posed.poses[k], x_.segment(place, free_count));
  }
}

void MotionFit::solve(const Progress& progress) {
  MotionFitProgram program(generic_, data_);
  const NlpReport report = solveNonlinearProgram(program, motion_.solver, progress, x_);
  result_.iterations = report.iterations;
  result_.converged = report.stop == NlpStop::kSolved || report.stop == NlpStop::kAcceptable;
}

void MotionFit::storeSizes(MotionFitResult& result) const {
  for (std::size_t g = 0; g < data_.groups.size(); ++g) {
    const auto i = static_cast<Eigen::Index>(g);
    SizeEstimate size;
    size.name = data_.groups[g].name;
    size.factor = x_[i];
    size.expected = expected_;
    size.deviations = (x_[i] - expected_) / (expected_ * data_.groups[g].deviation);
    const double margin = 1e-3 * expected_;
    size.at_bound = x_[i] < data_.size_lower[i] + margin || x_[i] > data_.size_upper[i] - margin;
    result.sizes.push_back(size);
  }
}

void MotionFit::placeMarkers(const MotionFitProgram& program, ScaleResult& result) const {
  for (std::size_t m = 0; m < data_.markers.size(); ++m) {
    const int start = program.offsetStart(static_cast<int>(m));
    if (start < 0) {
      continue;
    }
    const Eigen::Vector3d offset = x_.segment<3>(start);
    result.model.markers[at(result.model.findMarker(data_.markers[m]))].location += offset;
    result.motion->moved_markers.push_back(data_.markers[m]);
    result.motion->offsets.push_back(
        {data_.markers[m], offset.norm(), offset.norm() / data_.offset_deviations[m]});
  }
}

// Measured markers that weigh nothing, and may move, go where they are seen on average.
void MotionFit::placeUnweighted(const MotionFitProgram& program, ScaleResult& result) const {
  const Model model(makeKinematicModel(result.model));
  ModelState state(model);
  Eigen::VectorXd q(model.coordinateCount());
  const FreeCoordinates& free = program.freeCoordinates();
  for (MarkerSpec& marker : result.model.markers) {
    const bool weighted =
        std::find(data_.markers.begin(), data_.markers.end(), marker.name) != data_.markers.end();
    const std::optional<int> column = trial_.findMarker(marker.name);
    if (weighted || marker.fixed || !column || marker.body == "ground") {
      continue;
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int seen = 0;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      if (!trial_.isMissing(frames_[k], *column)) {
        free.expandPose(x_.segment(program.poseStart(static_cast<int>(k)), free.count()), q);
        state.setPose(q);
        const Pose& X_GB = state.pose(model.getBody(marker.body));
        sum += X_GB.R.transpose() * (trial_.position(frames_[k], *column) - X_GB.p);
        ++seen;
      }
    }
    if (seen > 0) {
      marker.location = sum / seen;
      result.motion->moved_markers.push_back(marker.name);
    }
  }
}

void MotionFit::removeUnmeasured(ScaleResult& result) const {
  std::vector<MarkerSpec> kept;
  for (const MarkerSpec& marker : result.model.markers) {
    if (trial_.findMarker(marker.name)) {
      kept.push_back(marker);
    } else {
      result.motion->removed_markers.push_back(marker.name);
    }
  }
  result.model.markers = std::move(kept);
}

void MotionFit::finish(const Progress& progress, ScaleResult& result) {
  MotionFitProgram program(generic_, data_);
  result_.markers = data_.markers;
  const Eigen::MatrixXd errors = program.calcErrors(x_);
  result_.frames_rms = calcRms(errors.reshaped());
  storeSizes(result_);
  result.motion = result_;
  result.factors = calcBodyScales(
      generic_, data_.groups, x_.head(static_cast<Eigen::Index>(data_.groups.size())));
  result.model = applyScaleFactors(generic_,
                                   result.factors,
                                   options_.marker_set.preserve_mass_distribution
                                       ? MassDistribution::kPreserved
                                       : MassDistribution::kFollowsVolume);
  placeMarkers(program, result);
  removeUnmeasured(result);
  placeUnweighted(program, result);
  const Model model(makeKinematicModel(result.model));
  MarkerFit fit(model, options_.marker_set.ik, trial_.names, options_.fit);
  result.motion->motion_rms =
      poseFrames(model, fit, trial_, thinOut(), PoseStart::kPrevious, progress).mean_rms;
}

void warnOfFit(const MotionScaleOptions& options, ScaleResult& result) {
  const MotionFitResult& fit = *result.motion;
  if (!fit.converged) {
    result.warnings.push_back("sizes, marker offsets and poses did not converge together after " +
                              std::to_string(fit.iterations) + " iterations");
  }
  if (fit.motion_rms > options.warn_rms) {
    result.warnings.push_back("the model fitted to the motion meets its markers to " +
                              formatFixed(100 * fit.motion_rms, 1) + " cm RMS; below " +
                              formatFixed(100 * options.warn_rms, 0) + " cm is usual");
  }
  for (const SizeEstimate& size : fit.sizes) {
    if (size.at_bound || std::abs(size.deviations) > options.warn_deviations) {
      result.warnings.push_back("size '" + size.name + "' is " + formatFixed(size.factor, 3) +
                                " where the height lets expect " + formatFixed(size.expected, 3) +
                                (size.at_bound ? ", at the end of what is tried" : ""));
    }
  }
  for (const OffsetEstimate& offset : fit.offsets) {
    if (offset.deviations > options.warn_deviations) {
      result.warnings.push_back("marker " + offset.marker + " sits " +
                                formatFixed(100 * offset.distance, 1) +
                                " cm from its place on the generic model");
    }
  }
}

}  // namespace

MotionScaleSolver::MotionScaleSolver(ModelSpec generic,
                                     ScaleOptions options,
                                     MotionScaleOptions motion)
    : generic_(std::move(generic)), options_(std::move(options)), motion_(motion) {
  options_.validate();
  motion_.validate();
  addMarkers(options_.marker_set.markers, generic_);
}

ScaleResult MotionScaleSolver::solve(const MarkerTrajectories& trial,
                                     const Progress& progress) const {
  ScaleResult result;
  MotionFit fit(generic_, options_, motion_, trial);
  fit.start(partOf(progress, 0, kAfterStart));
  fit.solve(partOf(progress, kAfterStart, kAfterFit));
  fit.finish(partOf(progress, kAfterFit, 1), result);
  finishSubject(options_, result.model);
  result.mass = result.model.calcTotalMass();
  warnOfFit(motion_, result);
  return result;
}

}  // namespace gaitmill
