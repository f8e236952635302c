#include "core/intake/marker_proposals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include <Eigen/Dense>

#include "core/base/text.h"
#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr int kFewestMarkers = 8;
constexpr double kReach = 0.10;  // [m] farther from its landmark a marker is not proposed
constexpr double kMostConfidence = 0.3;
constexpr int kHeadings = 36;
constexpr double kSmallest = 0.85;  // of the generic person, who is 1.70 m tall
constexpr double kLargest = 1.20;
constexpr double kSizeStep = 0.05;
constexpr int kRefinements = 4;

/// Where bony landmarks of a standing person are from its pelvis [m].
struct Template {
  std::vector<const Landmark*> landmarks;
  Matrix3Xd positions;
};

/// Markers of one frame; known ones have a landmark.
struct Cloud {
  std::vector<std::string> names;
  Matrix3Xd positions;
  std::vector<const Landmark*> known;  // nullptr = not
};

/// Where the template stands: x -> size R(heading) x + place.
struct Stance {
  double heading = 0;  // [rad] about Y
  double size = 1;
  Vector3d place = Vector3d::Zero();
  double cost = std::numeric_limits<double>::infinity();
};

bool isOfArm(const Landmark& landmark) {
  return landmark.body.rfind("humerus", 0) == 0 || landmark.body.rfind("ulna", 0) == 0 ||
         landmark.body.rfind("radius", 0) == 0 || landmark.body.rfind("hand", 0) == 0;
}

/// An arm raised sideways turns about the shoulder centre: down becomes outward, outward up.
Vector3d raise(const Landmark& landmark, const Vector3d& hanging) {
  const bool right = landmark.side == Side::kRight;
  const Vector3d shoulder = calcStandingPosition(*findLandmark(right ? "RSJC" : "LSJC"));
  const Vector3d arm = hanging - shoulder;
  const double out = right ? 1 : -1;
  return shoulder + Vector3d(arm.x(), out * arm.z(), -out * arm.y());
}

Template makeTemplate(bool raised) {
  Template standing;
  for (const Landmark& landmark : landmarks()) {
    if (landmark.kind == LandmarkKind::kBony && landmark.source != LocationSource::kEstimate) {
      standing.landmarks.push_back(&landmark);
    }
  }
  standing.positions.resize(3, static_cast<Eigen::Index>(standing.landmarks.size()));
  for (std::size_t i = 0; i < standing.landmarks.size(); ++i) {
    const Landmark& landmark = *standing.landmarks[i];
    const Vector3d hanging = calcStandingPosition(landmark);
    standing.positions.col(static_cast<Eigen::Index>(i)) =
        raised && isOfArm(landmark) ? raise(landmark, hanging) : hanging;
  }
  return standing;
}

/// The frame in which most markers are seen, the first of equals.
Cloud findFullestFrame(const std::vector<const MarkerTrajectories*>& recordings,
                       const MarkerMapping& mapping) {
  const MarkerTrajectories* best = nullptr;
  int best_frame = 0;
  int most = 0;
  for (const MarkerTrajectories* recording : recordings) {
    for (int frame = 0; frame < recording->frameCount(); ++frame) {
      int seen = 0;
      for (int marker = 0; marker < recording->markerCount(); ++marker) {
        seen += recording->isMissing(frame, marker) ? 0 : 1;
      }
      if (seen > most) {
        best = recording;
        best_frame = frame;
        most = seen;
      }
    }
  }
  Cloud cloud;
  cloud.positions.resize(3, most);
  for (int marker = 0; best != nullptr && marker < best->markerCount(); ++marker) {
    if (best->isMissing(best_frame, marker)) {
      continue;
    }
    cloud.positions.col(static_cast<Eigen::Index>(cloud.names.size())) =
        best->position(best_frame, marker);
    cloud.names.push_back(best->names[static_cast<std::size_t>(marker)]);
    const MarkerName* name = mapping.find(cloud.names.back());
    cloud.known.push_back(name == nullptr ? nullptr : findLandmark(name->landmark));
  }
  return cloud;
}

Matrix3Xd place(const Template& standing, const Stance& stance) {
  const Eigen::AngleAxisd turn(stance.heading, Vector3d::UnitY());
  return ((stance.size * turn.toRotationMatrix()) * standing.positions).colwise() + stance.place;
}

/// The template's landmark for one marker: its own if that is known, else the nearest.
int findPartner(const Cloud& cloud, int marker, const Template& standing, const Matrix3Xd& placed) {
  const Landmark* known = cloud.known[static_cast<std::size_t>(marker)];
  if (known != nullptr) {
    const auto found = std::find(standing.landmarks.begin(), standing.landmarks.end(), known);
    return found == standing.landmarks.end() ? -1
                                             : static_cast<int>(found - standing.landmarks.begin());
  }
  Eigen::Index nearest = 0;
  (placed.colwise() - cloud.positions.col(marker)).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

/// Sum over the markers of the squared distance to their landmark, each at most (2 reach)^2, and
/// the mean way from the landmarks to the markers that are within it.
double calcCost(const Cloud& cloud,
                const Template& standing,
                const Matrix3Xd& placed,
                Vector3d& way) {
  constexpr double kFar = 4 * kReach * kReach;
  double cost = 0;
  Vector3d sum = Vector3d::Zero();
  int near = 0;
  for (int marker = 0; marker < cloud.positions.cols(); ++marker) {
    const int partner = findPartner(cloud, marker, standing, placed);
    if (partner < 0) {
      continue;
    }
    const Vector3d step = cloud.positions.col(marker) - placed.col(partner);
    cost += std::min(kFar, step.squaredNorm());
    if (step.squaredNorm() < kFar) {
      sum += step;
      ++near;
    }
  }
  way = sum / std::max(1, near);
  return cost;
}

/// Starts with the cloud's lowest marker at the height of the feet and its middle over the pelvis.
Stance settle(const Cloud& cloud, const Template& standing, double heading, double size) {
  Stance stance;
  stance.heading = heading;
  stance.size = size;
  stance.place = cloud.positions.rowwise().mean();
  stance.place.y() =
      cloud.positions.row(1).minCoeff() - size * standing.positions.row(1).minCoeff();
  for (int i = 0; i <= kRefinements; ++i) {
    Vector3d way = Vector3d::Zero();
    stance.cost = calcCost(cloud, standing, place(standing, stance), way);
    if (i < kRefinements) {
      stance.place += way;
    }
  }
  return stance;
}

Stance findStance(const Cloud& cloud, const Template& standing) {
  Stance best;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * M_PI * i / kHeadings;
    for (double size = kSmallest; size < kLargest; size += kSizeStep) {
      const Stance stance = settle(cloud, standing, heading, size);
      best = stance.cost < best.cost ? stance : best;
    }
  }
  return best;
}

struct Candidate {
  double distance = 0;  // [m]
  int marker = 0;
  int landmark = 0;
};

/// Pairs within reach of which neither is taken, nearest first.
std::vector<Candidate> listCandidates(const Cloud& cloud,
                                      const Template& standing,
                                      const Matrix3Xd& placed,
                                      const MarkerMapping& mapping) {
  std::vector<Candidate> candidates;
  for (int marker = 0; marker < cloud.positions.cols(); ++marker) {
    for (int i = 0; i < placed.cols(); ++i) {
      const double distance = (placed.col(i) - cloud.positions.col(marker)).norm();
      const std::string& landmark = standing.landmarks[static_cast<std::size_t>(i)]->name;
      if (cloud.known[static_cast<std::size_t>(marker)] == nullptr && distance < kReach &&
          mapping.findMeasured(landmark) == nullptr) {
        candidates.push_back({distance, marker, i});
      }
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance < b.distance;
  });
  return candidates;
}

void propose(const Candidate& candidate, const Landmark& landmark, MarkerName& name) {
  name.proposal = landmark.name;
  name.proposal_confidence = kMostConfidence * (1 - candidate.distance / kReach);
  name.reason += "; it lies " + formatFixed(100 * candidate.distance, 0) + " cm from where the " +
                 landmark.description + " of a standing person would be";
}

bool wantsProposal(const MarkerName& name) {
  return name.landmark.empty() && name.proposal.empty() && name.set.empty();
}

}  // namespace

void proposeLandmarks(const std::vector<const MarkerTrajectories*>& recordings,
                      MarkerMapping& mapping) {
  if (std::none_of(mapping.names.begin(), mapping.names.end(), wantsProposal)) {
    return;
  }
  const Cloud cloud = findFullestFrame(recordings, mapping);
  if (cloud.positions.cols() < kFewestMarkers) {
    return;
  }
  const Template hanging = makeTemplate(false);
  const Template raised = makeTemplate(true);
  const Stance down = findStance(cloud, hanging);
  const Stance up = findStance(cloud, raised);
  const bool is_raised = up.cost < down.cost;
  const Template& standing = is_raised ? raised : hanging;
  std::vector<bool> given(standing.landmarks.size(), false);
  for (const Candidate& candidate :
       listCandidates(cloud, standing, place(standing, is_raised ? up : down), mapping)) {
    const std::string& measured = cloud.names[static_cast<std::size_t>(candidate.marker)];
    const auto name = std::find_if(mapping.names.begin(),
                                   mapping.names.end(),
                                   [&](const MarkerName& n) { return n.measured == measured; });
    const auto landmark = static_cast<std::size_t>(candidate.landmark);
    if (name != mapping.names.end() && wantsProposal(*name) && !given[landmark]) {
      given[landmark] = true;
      propose(candidate, *standing.landmarks[landmark], *name);
    }
  }
}

}  // namespace gaitmill
