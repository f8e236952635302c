#include "core/analysis/marker_events.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/math/filters.h"

namespace gaitmill {

namespace {

constexpr double kPositionCutoff = 7.0;       // [Hz] of heel and toe against the pelvis
constexpr double kAccelerationCutoff = 10.0;  // [Hz] of the toe's height
constexpr double kLeastExcursion = 0.2;       // [m] of the heel against the pelvis in one stride
constexpr double kLeastStride = 0.35;         // [s] sprinters need 0.42 s
constexpr double kToeOffSearch = 0.2;         // [s] before the toe is farthest behind
constexpr int kLeastFrames = 12;

/// One signal over a stretch of frames without gaps, low-passed.
struct Stretch {
  Eigen::Index first = 0;
  Eigen::VectorXd values;
};

Eigen::VectorXd lowPass(const Eigen::VectorXd& values, double cutoff, double rate) {
  if (cutoff >= 0.45 * rate) {
    return values;
  }
  RowMatrix column = values;
  filterZeroPhase(makeButterworthLowPass(2, cutoff, rate, CutoffMeaning::kBothPasses), column);
  return column.col(0);
}

std::vector<Stretch> findStretches(const Eigen::VectorXd& values, double cutoff, double rate) {
  std::vector<Stretch> stretches;
  Eigen::Index first = 0;
  for (Eigen::Index i = 0; i <= values.size(); ++i) {
    if (i < values.size() && std::isfinite(values(i))) {
      continue;
    }
    if (i - first >= kLeastFrames) {
      stretches.push_back({first, lowPass(values.segment(first, i - first), cutoff, rate)});
    }
    first = i + 1;
  }
  return stretches;
}

/// Where between three samples a parabola through them has its extremum, in samples from the
/// middle one.
double refine(const Eigen::VectorXd& y, Eigen::Index i) {
  const double curvature = y(i - 1) - 2 * y(i) + y(i + 1);
  return curvature == 0 ? 0.0 : std::clamp(0.5 * (y(i - 1) - y(i + 1)) / curvature, -0.5, 0.5);
}

/// Local maxima above the middle of the range, the higher one where two are closer than a stride.
std::vector<Eigen::Index> findPeaks(const Eigen::VectorXd& y, double rate) {
  std::vector<Eigen::Index> peaks;
  const double middle = 0.5 * (y.maxCoeff() + y.minCoeff());
  if (y.maxCoeff() - y.minCoeff() < kLeastExcursion) {
    return peaks;
  }
  for (Eigen::Index i = 1; i + 1 < y.size(); ++i) {
    if (y(i) <= middle || y(i) < y(i - 1) || y(i) <= y(i + 1)) {
      continue;
    }
    if (peaks.empty() || static_cast<double>(i - peaks.back()) >= kLeastStride * rate) {
      peaks.push_back(i);
    } else if (y(i) > y(peaks.back())) {
      peaks.back() = i;
    }
  }
  return peaks;
}

/// Events of one foot.
class EventSearch {
 public:
  EventSearch(const GaitMotion& motion, Foot side)
      : motion_(motion),
        side_(side),
        rate_(static_cast<double>(motion.time.size() - 1) /
              (motion.time.back() - motion.time.front())) {}

  void addStrikes(std::vector<GaitEvent>& events) const {
    for (const Stretch& heel : findLead(motion_.foot(side_).heel, 1.0)) {
      for (const Eigen::Index peak : findPeaks(heel.values, rate_)) {
        add(GaitEvent::Kind::kFootStrike, heel.first + peak, refine(heel.values, peak), events);
      }
    }
  }

  void addToeOffs(std::vector<GaitEvent>& events) const {
    const Eigen::VectorXd height = motion_.foot(side_).toe.row(1).transpose();
    const std::vector<Stretch> heights = findStretches(height, kAccelerationCutoff, rate_);
    for (const Stretch& toe : findLead(motion_.foot(side_).toe, -1.0)) {
      for (const Eigen::Index peak : findPeaks(toe.values, rate_)) {
        addToeOff(heights, toe.first + peak, events);
      }
    }
  }

 private:
  /// How far a point is in front of the pelvis, times a sign, over the stretches it is seen.
  std::vector<Stretch> findLead(const Eigen::Matrix3Xd& point, double sign) const {
    const Eigen::VectorXd lead = sign * ((point - motion_.pelvis).transpose() * motion_.forward);
    return findStretches(lead, kPositionCutoff, rate_);
  }

  void addToeOff(const std::vector<Stretch>& heights,
                 Eigen::Index rearmost,
                 std::vector<GaitEvent>& events) const {
    for (const Stretch& height : heights) {
      const Eigen::Index last = rearmost - height.first;
      if (last < 2 || last + 2 >= height.values.size()) {
        continue;
      }
      const auto reach = static_cast<Eigen::Index>(std::lround(kToeOffSearch * rate_));
      const Eigen::VectorXd& y = height.values;
      const Eigen::Index n = y.size();
      const Eigen::VectorXd upward = y.head(n - 2) - 2 * y.segment(1, n - 2) + y.tail(n - 2);
      const Eigen::Index first = std::max<Eigen::Index>(0, last - 1 - reach);
      Eigen::Index best = 0;
      upward.segment(first, last - first).maxCoeff(&best);
      best += first;
      // At the record's very start the foot is leaving already: there is no toe-off to be seen.
      if (best > 0 && best + 1 < upward.size()) {
        add(GaitEvent::Kind::kToeOff, height.first + best + 1, refine(upward, best), events);
      }
    }
  }

  void add(GaitEvent::Kind kind,
           Eigen::Index frame,
           double offset,
           std::vector<GaitEvent>& events) const {
    const double time = motion_.time[static_cast<std::size_t>(frame)] + offset / rate_;
    events.push_back({kind, side_, time, GaitEvent::Source::kMarkers});
  }

  const GaitMotion& motion_;
  Foot side_;
  double rate_;
};

}  // namespace

std::vector<GaitEvent> findMarkerEvents(const GaitMotion& motion) {
  std::vector<GaitEvent> events;
  if (motion.time.size() < kLeastFrames) {
    return events;
  }
  for (const Foot side : {Foot::kRight, Foot::kLeft}) {
    const EventSearch search(motion, side);
    search.addStrikes(events);
    search.addToeOffs(events);
  }
  std::stable_sort(events.begin(), events.end(), [](const GaitEvent& a, const GaitEvent& b) {
    return a.time < b.time;
  });
  return events;
}

std::vector<Stance> findStances(const std::vector<GaitEvent>& events, double start, double end) {
  std::vector<Stance> stances;
  for (const Foot side : {Foot::kRight, Foot::kLeft}) {
    std::optional<Stance> open;
    bool seen_any = false;
    for (const GaitEvent& event : events) {
      if (event.foot != side) {
        continue;
      }
      const bool strikes = event.kind == GaitEvent::Kind::kFootStrike;
      if (!strikes && !open && !seen_any) {
        open = Stance{side, start, start, false, false};
      }
      seen_any = true;
      if (open) {
        open->end = event.time;
        open->has_toe_off = !strikes;
        stances.push_back(*open);
        open.reset();
      }
      if (strikes) {
        open = Stance{side, event.time, end, true, false};
      }
    }
    if (open) {
      stances.push_back(*open);
    }
  }
  std::stable_sort(stances.begin(), stances.end(), [](const Stance& a, const Stance& b) {
    return a.start < b.start;
  });
  return stances;
}

double calcDutyFactor(const std::vector<GaitEvent>& events) {
  std::vector<double> shares;
  for (const Foot side : {Foot::kRight, Foot::kLeft}) {
    std::vector<const GaitEvent*> own;
    for (const GaitEvent& event : events) {
      if (event.foot == side) {
        own.push_back(&event);
      }
    }
    for (std::size_t i = 0; i + 2 < own.size(); ++i) {
      const bool stride = own[i]->kind == GaitEvent::Kind::kFootStrike &&
                          own[i + 1]->kind == GaitEvent::Kind::kToeOff &&
                          own[i + 2]->kind == GaitEvent::Kind::kFootStrike;
      if (stride) {
        shares.push_back((own[i + 1]->time - own[i]->time) / (own[i + 2]->time - own[i]->time));
      }
    }
  }
  if (shares.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

}  // namespace gaitmill
