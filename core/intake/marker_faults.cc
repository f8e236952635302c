#include "core/intake/marker_faults.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/intake/marker_companions.h"
#include "core/math/natural_spline.h"

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr double kMisplaced = 0.015;    // [m] residual among companions that skin does not reach
constexpr double kBetterPlace = 0.4;    // of that, on the place of the other marker
constexpr int kShortestSwap = 2;        // [frames]
constexpr int kSwapBridge = 5;          // [frames] between two parts of one swap
constexpr double kJump = 0.020;         // [m] against the way until then
constexpr double kOtherWay = 0.3;       // of the jump, against the other marker's way
constexpr double kMinorPart = 0.35;     // of a recording: surely the wrong side of a single jump
constexpr double kLongestSpike = 0.05;  // [s]
constexpr int kMostSpikeFrames = 10;
constexpr double kLeastSpike = 0.020;      // [m]
constexpr double kSpikeOverNoise = 6.0;    // times what nine in ten frames stay below
constexpr double kSpikeResidual = 0.010;   // [m] among companions, where there are any
constexpr double kLeastDrift = 0.012;      // [m]
constexpr double kDriftOverScatter = 3.0;  // of the distance about its line
constexpr double kLargestScatter = 0.006;  // [m]
constexpr double kShortestTrend = 0.5;     // [s]
constexpr double kPostureExtent = 0.1;     // [m] half of the markers stay within
constexpr double kMarkerError = 0.010;     // [m] of any marker: skin, placement
constexpr int kSplineFrames = 12;          // at either side of a gap
constexpr double kSofter = 2.0;            // times the spread of the companion before
constexpr double kEven = 2e-4;             // [m] spreads that differ less are alike
constexpr double kThickness = 0.02;        // [m] least extent of a cluster across its length

class MarkerRepairer {
 public:
  MarkerRepairer(const MarkerFaultOptions& options, MarkerTrajectories& markers)
      : options_(options), markers_(markers) {
    repair_.weights.assign(static_cast<std::size_t>(markers.markerCount()), 1.0);
  }

  MarkerRepair repair() {
    const MarkerCompanions first(markers_);
    correctMisplacedPairs(first);
    correctCrossings();
    // Medians of distances are better without what was wrong.
    const MarkerCompanions companions(markers_);
    removeSpikes(companions);
    findDrifts();
    fillGaps(companions);
    return std::move(repair_);
  }

 private:
  using Frames = std::pair<int, int>;  // first, last

  Eigen::Vector3d at(int frame, int marker) const { return markers_.position(frame, marker); }
  bool isSeen(int frame, int marker) const {
    return frame >= 0 && frame < markers_.frameCount() && !markers_.isMissing(frame, marker);
  }
  void put(int frame, int marker, const Eigen::Vector3d& position) {
    markers_.positions.row(frame).segment<3>(Eigen::Index{3} * marker) = position.transpose();
  }
  const std::string& name(int marker) const {
    return markers_.names[static_cast<std::size_t>(marker)];
  }
  MarkerFault makeFault(MarkerFault::Kind kind, int marker, Frames frames, double size) const;
  void lowerWeight(int marker, double distance);

  void correctMisplacedPairs(const MarkerCompanions& companions);
  std::vector<Frames> findSwapped(const MarkerCompanions& companions,
                                  const std::vector<std::vector<bool>>& misplaced,
                                  int i,
                                  int j) const;
  bool fitsSwapped(const MarkerCompanions& companions, int frame, int i, int j) const;
  void swapNames(int i, int j, Frames frames);
  void correctCrossings();
  std::vector<int> findJumps(int marker) const;
  std::vector<int> findCrossings(int i, int j, const std::vector<int>& jumps) const;
  bool isCrossing(int frame, int i, int j) const;
  void correctCrossing(int i, int j, const std::vector<int>& crossings);

  void removeSpikes(const MarkerCompanions& companions);
  /// One marker over all frames, which lie side by side: neighbours are looked at often.
  struct Track {
    Eigen::Matrix3Xd positions;
    std::vector<char> is_seen;
  };
  /// (4 x count) of the cubic through two frames before and two after `count` frames, at these.
  using CubicWeights = Eigen::Matrix4Xd;
  Track makeTrack(int marker) const;
  static CubicWeights makeCubicWeights(int count);
  static std::optional<double> findDetour(const Track& track,
                                          const CubicWeights& weights,
                                          int first,
                                          double enough);
  static double findUsualDetour(const Track& track, const CubicWeights& weights);
  void removeSpikesOf(int marker, int count, const MarkerCompanions& companions, Track& track);
  bool isStep(int marker, int first, int count, double detour) const;

  bool isPosture() const;
  void findDrifts();
  std::optional<double> findTrend(int i, int j) const;

  void fillGaps(const MarkerCompanions& companions);
  void fillGap(const MarkerCompanions& companions, int marker, Frames gap);
  bool fillByCluster(const MarkerCompanions& companions, int marker, Frames gap);
  void fillBySpline(int marker, Frames gap);

  const MarkerFaultOptions& options_;
  MarkerTrajectories& markers_;
  MarkerRepair repair_;
};

MarkerFault MarkerRepairer::makeFault(MarkerFault::Kind kind,
                                      int marker,
                                      Frames frames,
                                      double size) const {
  MarkerFault fault;
  fault.kind = kind;
  fault.marker = name(marker);
  fault.first_frame = frames.first;
  fault.last_frame = frames.second;
  fault.start = markers_.time[static_cast<std::size_t>(frames.first)];
  fault.end = markers_.time[static_cast<std::size_t>(frames.second)];
  fault.size = size;
  return fault;
}

void MarkerRepairer::lowerWeight(int marker, double distance) {
  const double variance = kMarkerError * kMarkerError;
  repair_.weights[static_cast<std::size_t>(marker)] *=
      variance / (variance + distance * distance / 3.0);
}

// ---- swaps ----

bool MarkerRepairer::fitsSwapped(const MarkerCompanions& companions,
                                 int frame,
                                 int i,
                                 int j) const {
  if (!isSeen(frame, i) || !isSeen(frame, j)) {
    return false;
  }
  const Eigen::Vector3d p_i = at(frame, i);
  const Eigen::Vector3d p_j = at(frame, j);
  const auto i_here = companions.findResidual(markers_, frame, i, p_i, j);
  const auto j_here = companions.findResidual(markers_, frame, j, p_j, i);
  const auto i_there = companions.findResidual(markers_, frame, i, p_j, j);
  const auto j_there = companions.findResidual(markers_, frame, j, p_i, i);
  return i_here && j_here && i_there && j_there && *i_here > kMisplaced && *j_here > kMisplaced &&
         *i_there < kBetterPlace * *i_here && *j_there < kBetterPlace * *j_here;
}

std::vector<MarkerRepairer::Frames> MarkerRepairer::findSwapped(
    const MarkerCompanions& companions,
    const std::vector<std::vector<bool>>& misplaced,
    int i,
    int j) const {
  std::vector<Frames> parts;
  for (int frame = 0; frame < markers_.frameCount(); ++frame) {
    const auto k = static_cast<std::size_t>(frame);
    if (!misplaced[static_cast<std::size_t>(i)][k] || !misplaced[static_cast<std::size_t>(j)][k] ||
        !fitsSwapped(companions, frame, i, j)) {
      continue;
    }
    if (!parts.empty() && frame - parts.back().second <= kSwapBridge) {
      parts.back().second = frame;
    } else {
      parts.emplace_back(frame, frame);
    }
  }
  parts.erase(std::remove_if(
                  parts.begin(),
                  parts.end(),
                  [](const Frames& part) { return part.second - part.first + 1 < kShortestSwap; }),
              parts.end());
  return parts;
}

void MarkerRepairer::swapNames(int i, int j, Frames frames) {
  double distance = 0;
  int count = 0;
  for (int frame = frames.first; frame <= frames.second; ++frame) {
    const Eigen::Vector3d p_i = at(frame, i);
    const Eigen::Vector3d p_j = at(frame, j);
    if (isSeen(frame, i) && isSeen(frame, j)) {
      distance += (p_i - p_j).norm();
      ++count;
    }
    put(frame, i, p_j);
    put(frame, j, p_i);
  }
  MarkerFault fault = makeFault(MarkerFault::Kind::kSwap, i, frames, distance / std::max(count, 1));
  fault.other = name(j);
  fault.action = MarkerFault::Action::kCorrected;
  repair_.faults.push_back(fault);
}

void MarkerRepairer::correctMisplacedPairs(const MarkerCompanions& companions) {
  const int n = markers_.markerCount();
  std::vector<std::vector<bool>> misplaced(static_cast<std::size_t>(n));
  std::vector<int> suspects;
  for (int i = 0; i < n; ++i) {
    std::vector<bool>& frames = misplaced[static_cast<std::size_t>(i)];
    frames.assign(static_cast<std::size_t>(markers_.frameCount()), false);
    int count = 0;
    for (int frame = 0; frame < markers_.frameCount(); ++frame) {
      if (!isSeen(frame, i)) {
        continue;
      }
      const auto residual = companions.findResidual(markers_, frame, i, at(frame, i));
      frames[static_cast<std::size_t>(frame)] = residual && *residual > 0.5 * kMisplaced;
      count += frames[static_cast<std::size_t>(frame)] ? 1 : 0;
    }
    if (count >= kShortestSwap) {
      suspects.push_back(i);
    }
  }
  for (std::size_t a = 0; a < suspects.size(); ++a) {
    for (std::size_t b = a + 1; b < suspects.size(); ++b) {
      for (const Frames& frames : findSwapped(companions, misplaced, suspects[a], suspects[b])) {
        swapNames(suspects[a], suspects[b], frames);
      }
    }
  }
}

/// Whether both markers jump, in this frame, to where the other was on its way to.
bool MarkerRepairer::isCrossing(int frame, int i, int j) const {
  const Eigen::Vector3d way_i = 2.0 * at(frame - 1, i) - at(frame - 2, i);
  const Eigen::Vector3d way_j = 2.0 * at(frame - 1, j) - at(frame - 2, j);
  const double jump_i = (at(frame, i) - way_i).norm();
  const double jump_j = (at(frame, j) - way_j).norm();
  return jump_i > kJump && jump_j > kJump && (at(frame, i) - way_j).norm() < kOtherWay * jump_i &&
         (at(frame, j) - way_i).norm() < kOtherWay * jump_j &&
         // Not for a fast pair whose one follows the other's track.
         (at(frame, i) - at(frame - 1, j)).norm() < 0.5 * (at(frame, i) - at(frame - 1, i)).norm();
}

/// Frames in which a marker is farther than kJump from where it was on its way to.
std::vector<int> MarkerRepairer::findJumps(int marker) const {
  std::vector<int> jumps;
  for (int frame = 2; frame < markers_.frameCount(); ++frame) {
    const Eigen::Vector3d step = at(frame, marker) - at(frame - 1, marker);
    const Eigen::Vector3d before = at(frame - 1, marker) - at(frame - 2, marker);
    // False for what is not seen, which is not a number.
    if ((step - before).squaredNorm() > kJump * kJump) {
      jumps.push_back(frame);
    }
  }
  return jumps;
}

/// @param jumps  frames in which both markers jump
std::vector<int> MarkerRepairer::findCrossings(int i, int j, const std::vector<int>& jumps) const {
  std::vector<int> crossings;
  for (const int frame : jumps) {
    // Extrapolation from the two sides of a jump means nothing.
    const bool follows = !crossings.empty() && frame == crossings.back() + 1;
    if (!follows && isCrossing(frame, i, j)) {
      crossings.push_back(frame);
    }
  }
  return crossings;
}

void MarkerRepairer::correctCrossing(int i, int j, const std::vector<int>& crossings) {
  const int frames = markers_.frameCount();
  std::size_t k = 0;
  for (; k + 1 < crossings.size(); k += 2) {
    swapNames(i, j, {crossings[k], crossings[k + 1] - 1});
  }
  if (k == crossings.size()) {
    return;
  }
  const int after = frames - crossings[k];
  const int before = crossings[k];
  if (after < kMinorPart * frames) {
    swapNames(i, j, {crossings[k], frames - 1});
  } else if (before < kMinorPart * frames && k == 0) {
    swapNames(i, j, {0, crossings[k] - 1});
  } else {
    const double distance = (at(crossings[k], i) - at(crossings[k], j)).norm();
    MarkerFault fault =
        makeFault(MarkerFault::Kind::kSwap, i, {crossings[k], frames - 1}, distance);
    fault.other = name(j);
    fault.action = MarkerFault::Action::kWeighed;
    repair_.faults.push_back(fault);
    lowerWeight(i, distance);
    lowerWeight(j, distance);
  }
}

// What companions cannot tell: markers without any, and pairs that lie alike to theirs.
void MarkerRepairer::correctCrossings() {
  // Few frames have jumps: pairs look at no others, however long the recording is.
  std::vector<std::vector<int>> jumps;
  for (int i = 0; i < markers_.markerCount(); ++i) {
    jumps.push_back(findJumps(i));
  }
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    for (std::size_t j = i + 1; j < jumps.size(); ++j) {
      std::vector<int> both;
      std::set_intersection(jumps[i].begin(),
                            jumps[i].end(),
                            jumps[j].begin(),
                            jumps[j].end(),
                            std::back_inserter(both));
      const auto first = static_cast<int>(i);
      const auto second = static_cast<int>(j);
      const std::vector<int> crossings = findCrossings(first, second, both);
      if (!crossings.empty()) {
        correctCrossing(first, second, crossings);
        jumps[i] = findJumps(first);
        jumps[j] = findJumps(second);
      }
    }
  }
}

// ---- spikes ----

MarkerRepairer::Track MarkerRepairer::makeTrack(int marker) const {
  Track track;
  track.positions.resize(3, markers_.frameCount());
  track.is_seen.resize(static_cast<std::size_t>(markers_.frameCount()));
  for (int frame = 0; frame < markers_.frameCount(); ++frame) {
    track.positions.col(frame) = at(frame, marker);
    track.is_seen[static_cast<std::size_t>(frame)] = isSeen(frame, marker) ? 1 : 0;
  }
  return track;
}

MarkerRepairer::CubicWeights MarkerRepairer::makeCubicWeights(int count) {
  const double x[4] = {-2.0, -1.0, static_cast<double>(count), count + 1.0};
  CubicWeights weights(4, count);
  for (int k = 0; k < count; ++k) {
    for (int a = 0; a < 4; ++a) {
      double weight = 1;
      for (int b = 0; b < 4; ++b) {
        weight *= a == b ? 1.0 : (k - x[b]) / (x[a] - x[b]);
      }
      weights(a, k) = weight;
    }
  }
  return weights;
}

/// Least distance of the frames first ... from the cubic through two frames at either side, or
/// nullopt if one of the frames is not seen.
/// @param enough  a distance below it is returned as soon as it is found
std::optional<double> MarkerRepairer::findDetour(const Track& track,
                                                 const CubicWeights& weights,
                                                 int first,
                                                 double enough) {
  const auto count = static_cast<int>(weights.cols());
  const int after = first + count;
  for (int frame = first - 2; frame <= after + 1; ++frame) {
    if (track.is_seen[static_cast<std::size_t>(frame)] == 0) {
      return std::nullopt;
    }
  }
  const Eigen::Matrix3Xd& p = track.positions;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count && least >= enough; ++k) {
    const Eigen::Vector3d way = weights(0, k) * p.col(first - 2) +
                                weights(1, k) * p.col(first - 1) + weights(2, k) * p.col(after) +
                                weights(3, k) * p.col(after + 1);
    least = std::min(least, (p.col(first + k) - way).norm());
  }
  return least;
}

/// Whether the way does not go on after the frames where it was before them: the straight
/// continuations from both sides miss each other in the middle.
bool MarkerRepairer::isStep(int marker, int first, int count, double detour) const {
  const int after = first + count;
  const double half = 0.5 * (count + 1);
  const Eigen::Vector3d from_before =
      at(first - 1, marker) + half * (at(first - 1, marker) - at(first - 2, marker));
  const Eigen::Vector3d from_after =
      at(after, marker) - half * (at(after + 1, marker) - at(after, marker));
  return (from_before - from_after).norm() > 0.5 * detour;
}

double MarkerRepairer::findUsualDetour(const Track& track, const CubicWeights& weights) {
  std::vector<double> detours;
  const auto frames = static_cast<int>(track.positions.cols());
  for (int frame = 2; frame + weights.cols() + 1 < frames; ++frame) {
    if (const auto detour = findDetour(track, weights, frame, 0)) {
      detours.push_back(*detour);
    }
  }
  if (detours.empty()) {
    return 0;
  }
  const auto ninth = detours.begin() + static_cast<std::ptrdiff_t>(detours.size() * 9 / 10);
  std::nth_element(detours.begin(), ninth, detours.end());
  return *ninth;
}

/// Spikes of `count` frames of one marker.
void MarkerRepairer::removeSpikesOf(int marker,
                                    int count,
                                    const MarkerCompanions& companions,
                                    Track& track) {
  const CubicWeights weights = makeCubicWeights(count);
  // Asked for where something stands out at all: it looks at every frame once more.
  std::optional<double> threshold;
  for (int first = 2; first + count + 1 < markers_.frameCount(); ++first) {
    const auto detour = findDetour(track, weights, first, kLeastSpike);
    if (!detour || *detour < kLeastSpike) {
      continue;
    }
    if (!threshold) {
      threshold = std::max(kLeastSpike, kSpikeOverNoise * findUsualDetour(track, weights));
    }
    if (*detour < *threshold || isStep(marker, first, count, *detour)) {
      continue;
    }
    const auto residual = companions.findResidual(markers_, first, marker, at(first, marker));
    if (residual && *residual < kSpikeResidual) {
      continue;
    }
    MarkerFault fault =
        makeFault(MarkerFault::Kind::kSpike, marker, {first, first + count - 1}, *detour);
    fault.action = MarkerFault::Action::kRemoved;
    repair_.faults.push_back(fault);
    for (int frame = first; frame < first + count; ++frame) {
      put(frame, marker, Eigen::Vector3d::Constant(kNaN));
      track.is_seen[static_cast<std::size_t>(frame)] = 0;
    }
  }
}

void MarkerRepairer::removeSpikes(const MarkerCompanions& companions) {
  const double rate = markers_.rate > 0 ? markers_.rate : 100.0;
  const int longest = std::clamp(static_cast<int>(kLongestSpike * rate), 1, kMostSpikeFrames);
  for (int marker = 0; marker < markers_.markerCount(); ++marker) {
    Track track = makeTrack(marker);
    // Long ones first: their parts look like steps.
    for (int count = longest; count >= 1; --count) {
      removeSpikesOf(marker, count, companions, track);
    }
  }
}

// ---- drifts ----

/// Change of the distance over the recording along the line through it, or nullopt if the distance
/// scatters about that line as between two segments.
std::optional<double> MarkerRepairer::findTrend(int i, int j) const {
  double n = 0;
  double st = 0;
  double sd = 0;
  double stt = 0;
  double std = 0;
  double sdd = 0;
  for (int frame = 0; frame < markers_.frameCount(); ++frame) {
    const double d = (at(frame, i) - at(frame, j)).norm();
    if (std::isfinite(d)) {
      const double t = markers_.time[static_cast<std::size_t>(frame)] - markers_.time.front();
      n += 1;
      st += t;
      sd += d;
      stt += t * t;
      std += t * d;
      sdd += d * d;
    }
  }
  const double span = markers_.time.back() - markers_.time.front();
  if (n < 0.7 * markers_.frameCount() || n < 10 || span < kShortestTrend) {
    return std::nullopt;
  }
  const double vtt = stt / n - st * st / (n * n);
  const double vtd = std / n - st * sd / (n * n);
  const double vdd = sdd / n - sd * sd / (n * n);
  const double slope = vtd / vtt;
  const double scatter = std::sqrt(std::max(0.0, vdd - slope * vtd));
  const double trend = slope * span;
  if (scatter > kLargestScatter) {
    return std::nullopt;
  }
  return std::abs(trend) > kDriftOverScatter * scatter ? std::abs(trend) : 0.0;
}

/// Whether the body stands: then a slow change of posture looks like a drift.
bool MarkerRepairer::isPosture() const {
  int still = 0;
  for (int marker = 0; marker < markers_.markerCount(); ++marker) {
    Eigen::AlignedBox3d box;
    for (int frame = 0; frame < markers_.frameCount(); ++frame) {
      if (isSeen(frame, marker)) {
        box.extend(at(frame, marker));
      }
    }
    still += box.isEmpty() || box.diagonal().norm() < kPostureExtent ? 1 : 0;
  }
  return 2 * still >= markers_.markerCount();
}

void MarkerRepairer::findDrifts() {
  const int n = markers_.markerCount();
  if (markers_.frameCount() == 0 || isPosture()) {
    return;
  }
  // A drifting marker is no companion by its spread any more, so all pairs are looked at; far ones
  // lie on one segment by accident.
  constexpr double kFarthest = 0.5;  // [m]
  Eigen::MatrixXd trends = Eigen::MatrixXd::Constant(n, n, kNaN);
  const int middle = markers_.frameCount() / 2;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const double distance = (at(middle, i) - at(middle, j)).norm();
      const auto trend = distance > kFarthest ? std::nullopt : findTrend(i, j);
      trends(i, j) = trends(j, i) = trend.value_or(kNaN);
    }
  }
  std::vector<bool> drifts(static_cast<std::size_t>(n), false);
  for (;;) {
    int worst = -1;
    Eigen::Vector2d worst_trends(kLeastDrift, 0);  // second largest, largest
    for (int i = 0; i < n; ++i) {
      Eigen::Vector2d largest(0, 0);
      for (int j = 0; j < n; ++j) {
        const double trend = trends(i, j);
        if (drifts[static_cast<std::size_t>(j)] || std::isnan(trend)) {
          continue;
        }
        largest[0] = std::max(largest[0], std::min(largest[1], trend));
        largest[1] = std::max(largest[1], trend);
      }
      if (!drifts[static_cast<std::size_t>(i)] && largest[0] > worst_trends[0]) {
        worst = i;
        worst_trends = largest;
      }
    }
    if (worst < 0) {
      break;
    }
    drifts[static_cast<std::size_t>(worst)] = true;
    MarkerFault fault = makeFault(
        MarkerFault::Kind::kDrift, worst, {0, markers_.frameCount() - 1}, worst_trends[1]);
    fault.action = MarkerFault::Action::kWeighed;
    repair_.faults.push_back(fault);
    lowerWeight(worst, worst_trends[1]);
  }
}

// ---- gaps ----

/// Rigid motion that brings the columns of `from` closest to those of `to`.
Eigen::Isometry3d fitMotion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Vector3d p = from.rowwise().mean();
  const Eigen::Vector3d q = to.rowwise().mean();
  const Eigen::Matrix3d covariance = (to.colwise() - q) * (from.colwise() - p).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * sign * svd.matrixV().transpose();
  motion.translation() = q - motion.linear() * p;
  return motion;
}

bool MarkerRepairer::fillByCluster(const MarkerCompanions& companions, int marker, Frames gap) {
  const int before = gap.first - 1;
  const int after = gap.second + 1;
  std::vector<int> cluster;
  double spread = 0;
  for (const Companion& companion : companions.of(marker)) {
    if (cluster.size() >= 3 && companion.spread > kSofter * spread + kEven) {
      break;  // the others would only bend the motion
    }
    spread = companion.spread;
    bool seen = true;
    for (int frame = before; frame <= after && seen; ++frame) {
      seen = isSeen(frame, companion.marker);
    }
    if (seen) {
      cluster.push_back(companion.marker);
    }
  }
  if (cluster.size() < 3) {
    return false;
  }
  const auto gather = [&](int frame) {
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(cluster.size()));
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      points.col(static_cast<Eigen::Index>(k)) = at(frame, cluster[k]);
    }
    return points;
  };
  const Eigen::Matrix3Xd start = gather(before);
  const Eigen::Matrix3Xd centred = start.colwise() - start.rowwise().mean();
  const Eigen::Vector3d extents = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues();
  if (extents[1] < kThickness) {
    return false;  // on a line, about which it could turn
  }
  // The marker's place in the cluster moves from where it was before to where it is after.
  const Eigen::Vector3d place_before = at(before, marker);
  const Eigen::Vector3d place_after = fitMotion(start, gather(after)).inverse() * at(after, marker);
  for (int frame = gap.first; frame <= gap.second; ++frame) {
    const double part = static_cast<double>(frame - before) / (after - before);
    const Eigen::Vector3d place = (1 - part) * place_before + part * place_after;
    put(frame, marker, fitMotion(start, gather(frame)) * place);
  }
  return true;
}

void MarkerRepairer::fillBySpline(int marker, Frames gap) {
  std::vector<int> frames;
  for (int frame = gap.first - 1, n = 0; isSeen(frame, marker) && n < kSplineFrames; --frame, ++n) {
    frames.insert(frames.begin(), frame);
  }
  for (int frame = gap.second + 1, n = 0; isSeen(frame, marker) && n < kSplineFrames;
       ++frame, ++n) {
    frames.push_back(frame);
  }
  std::vector<double> times;
  RowMatrix values(static_cast<Eigen::Index>(frames.size()), 3);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    times.push_back(markers_.time[static_cast<std::size_t>(frames[k])]);
    values.row(static_cast<Eigen::Index>(k)) = at(frames[k], marker).transpose();
  }
  Eigen::VectorXd position(3);
  if (frames.size() >= 4) {
    const NaturalSpline spline(times, values, 3);
    for (int frame = gap.first; frame <= gap.second; ++frame) {
      spline.evaluate(markers_.time[static_cast<std::size_t>(frame)], position);
      put(frame, marker, position);
    }
    return;
  }
  const Eigen::Vector3d before = at(gap.first - 1, marker);
  const Eigen::Vector3d after = at(gap.second + 1, marker);
  for (int frame = gap.first; frame <= gap.second; ++frame) {
    const double part = static_cast<double>(frame - gap.first + 1) / (gap.second - gap.first + 2);
    put(frame, marker, (1 - part) * before + part * after);
  }
}

void MarkerRepairer::fillGap(const MarkerCompanions& companions, int marker, Frames gap) {
  MarkerFault fault = makeFault(MarkerFault::Kind::kGap, marker, gap, kNaN);
  const bool is_inside = gap.first > 0 && gap.second + 1 < markers_.frameCount();
  if (is_inside && options_.max_gap > 0) {
    // Between the frames that are seen lies one step more than there are frames missing.
    const double length = markers_.time[static_cast<std::size_t>(gap.second + 1)] -
                          markers_.time[static_cast<std::size_t>(gap.first - 1)];
    const double step = length / (gap.second - gap.first + 2);
    if (length - step <= options_.max_gap * (1 + 1e-9)) {
      fault.action = MarkerFault::Action::kFilled;
      if (!fillByCluster(companions, marker, gap)) {
        fillBySpline(marker, gap);
      }
    }
  }
  // The hole that a spike leaves is part of that fault.
  bool is_of_spike = false;
  for (MarkerFault& other : repair_.faults) {
    if (other.kind == MarkerFault::Kind::kSpike && other.marker == fault.marker &&
        other.first_frame >= gap.first && other.last_frame <= gap.second) {
      is_of_spike = is_of_spike || other.first_frame == gap.first;
      other.action = fault.action == MarkerFault::Action::kFilled ? fault.action : other.action;
    }
  }
  if (!is_of_spike) {
    repair_.faults.push_back(fault);
  }
}

void MarkerRepairer::fillGaps(const MarkerCompanions& companions) {
  const int frames = markers_.frameCount();
  for (int marker = 0; marker < markers_.markerCount(); ++marker) {
    for (int frame = 0; frame < frames; ++frame) {
      if (isSeen(frame, marker)) {
        continue;
      }
      Frames gap{frame, frame};
      while (gap.second + 1 < frames && !isSeen(gap.second + 1, marker)) {
        ++gap.second;
      }
      fillGap(companions, marker, gap);
      frame = gap.second;
    }
  }
}

}  // namespace

MarkerRepair repairMarkers(const MarkerFaultOptions& options, MarkerTrajectories& markers) {
  return MarkerRepairer(options, markers).repair();
}

const char* faultName(MarkerFault::Kind kind) {
  switch (kind) {
    case MarkerFault::Kind::kGap:
      return "gap";
    case MarkerFault::Kind::kSwap:
      return "swap";
    case MarkerFault::Kind::kSpike:
      return "spike";
    case MarkerFault::Kind::kDrift:
      break;
  }
  return "drift";
}

const char* actionName(MarkerFault::Action action) {
  switch (action) {
    case MarkerFault::Action::kReported:
      return "reported";
    case MarkerFault::Action::kFilled:
      return "filled";
    case MarkerFault::Action::kCorrected:
      return "corrected";
    case MarkerFault::Action::kRemoved:
      return "removed";
    case MarkerFault::Action::kWeighed:
      break;
  }
  return "weight_lowered";
}

std::string describeFault(const MarkerFault& fault) {
  const std::string when =
      fault.first_frame == fault.last_frame
          ? "at " + formatFixed(fault.start, 3) + " s"
          : "from " + formatFixed(fault.start, 3) + " s to " + formatFixed(fault.end, 3) + " s";
  const std::string size = formatShort(1000.0 * fault.size) + " mm";
  switch (fault.kind) {
    case MarkerFault::Kind::kGap:
      return "marker " + fault.marker + " is not seen " + when +
             (fault.action == MarkerFault::Action::kFilled ? "; filled" : "; left missing");
    case MarkerFault::Kind::kSwap:
      return "markers " + fault.marker + " and " + fault.other + ", " + size +
             " apart, carry each other's name " + when +
             (fault.action == MarkerFault::Action::kCorrected
                  ? "; corrected"
                  : ", or before it; their weights are lowered");
    case MarkerFault::Kind::kSpike:
      return "marker " + fault.marker + " jumps " + size + " away " + when +
             (fault.action == MarkerFault::Action::kFilled ? "; removed and filled" : "; removed");
    case MarkerFault::Kind::kDrift:
      break;
  }
  return "marker " + fault.marker + " drifts " + size + " against its segment " + when +
         "; its weight is lowered";
}

}  // namespace gaitmill
