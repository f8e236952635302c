#include "core/analysis/foot_motion.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestBridge = 0.1;  // [s]

/// "lab:R.Heel_2" -> "RHEEL2"
std::string normalize(const std::string& marker) {
  std::string letters;
  for (const char c : marker.substr(marker.rfind(':') + 1)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return letters;
}

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// How a name begins behind its side, and how well such a marker tells the end of the foot: the
/// smaller the better, 0 = not at all.
struct NamePart {
  std::string_view start;
  int heel;
  int toe;
};
constexpr std::array<NamePart, 9> kFootParts = {{{"HEE", 1, 0},
                                                 {"CAL", 1, 0},
                                                 {"TOE", 0, 1},
                                                 {"MT", 0, 2},
                                                 {"ANK", 2, 0},
                                                 {"MAL", 2, 0},
                                                 {"LMAL", 2, 0},
                                                 {"MMAL", 2, 0},
                                                 {"FOOT", 0, 3}}};
constexpr std::array<std::string_view, 5> kPelvisParts = {"ASI", "PSI", "SAC", "VSAC", "S2"};

const NamePart* findPart(std::string_view letters) {
  const auto* found = std::find_if(kFootParts.begin(), kFootParts.end(), [&](const NamePart& part) {
    return startsWith(letters, part.start);
  });
  return found == kFootParts.end() ? nullptr : found;
}

Foot readSide(char letter) {
  return letter == 'R' ? Foot::kRight : letter == 'L' ? Foot::kLeft : Foot::kUnknown;
}

/// The side and the part of the foot that a name states.
std::pair<Foot, const NamePart*> readFootMarker(const std::string& marker) {
  const std::string letters = normalize(marker);
  if (letters.size() < 3) {
    return {Foot::kUnknown, nullptr};
  }
  const std::string_view all(letters);
  if (readSide(all.front()) != Foot::kUnknown) {
    if (const NamePart* part = findPart(all.substr(1))) {
      return {readSide(all.front()), part};
    }
  }
  const NamePart* part = findPart(all);
  return {part == nullptr ? Foot::kUnknown : readSide(all.back()), part};
}

bool isOnPelvis(const std::string& marker) {
  const std::string letters = normalize(marker);
  const std::string_view all(letters);
  return std::any_of(kPelvisParts.begin(), kPelvisParts.end(), [&](std::string_view part) {
    const bool sided = all.size() > 1 && readSide(all.front()) != Foot::kUnknown;
    return startsWith(all, part) || (sided && startsWith(all.substr(1), part));
  });
}

/// Fills gaps between two frames that are seen and at most kLongestBridge apart.
void bridgeGaps(const std::vector<double>& time, Eigen::Matrix3Xd& path) {
  Eigen::Index seen = -1;
  for (Eigen::Index i = 0; i < path.cols(); ++i) {
    if (!path.col(i).allFinite()) {
      continue;
    }
    const auto at = [&](Eigen::Index row) {
      return time[static_cast<std::size_t>(row)];
    };
    if (seen >= 0 && i - seen > 1 && at(i) - at(seen) <= kLongestBridge) {
      for (Eigen::Index j = seen + 1; j < i; ++j) {
        const double share = (at(j) - at(seen)) / (at(i) - at(seen));
        path.col(j) = (1 - share) * path.col(seen) + share * path.col(i);
      }
    }
    seen = i;
  }
}

Eigen::Matrix3Xd copyMarker(const MarkerTrajectories& markers, int marker) {
  Eigen::Matrix3Xd path(3, markers.frameCount());
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    path.col(frame) = markers.isMissing(frame, marker) ? Eigen::Vector3d::Constant(kNaN)
                                                       : markers.position(frame, marker);
  }
  bridgeGaps(markers.time, path);
  return path;
}

/// The first of the candidates that is seen at all: a mean over several would jump at each gap.
Eigen::Matrix3Xd findPath(const MarkerTrajectories& markers, const std::vector<int>& candidates) {
  for (const int marker : candidates) {
    Eigen::Matrix3Xd path = copyMarker(markers, marker);
    if (path.array().isFinite().any()) {
      return path;
    }
  }
  return Eigen::Matrix3Xd::Constant(3, markers.frameCount(), kNaN);
}

FootMotion makeFoot(const MarkerTrajectories& markers, const FootMarkers& chosen) {
  FootMotion foot{findPath(markers, chosen.heel), findPath(markers, chosen.toe)};
  if (!foot.heel.array().isFinite().any()) {
    foot.heel = foot.toe;
  } else if (!foot.toe.array().isFinite().any()) {
    foot.toe = foot.heel;
  }
  return foot;
}

Eigen::Matrix3Xd makeCenter(const MarkerTrajectories& markers, std::vector<int> chosen) {
  if (chosen.empty()) {
    for (int i = 0; i < markers.markerCount(); ++i) {
      chosen.push_back(i);
    }
  }
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, markers.frameCount());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(markers.frameCount());
  for (const int marker : chosen) {
    const Eigen::Matrix3Xd path = copyMarker(markers, marker);
    for (Eigen::Index i = 0; i < path.cols(); ++i) {
      if (path.col(i).allFinite()) {
        sum.col(i) += path.col(i);
        count(i) += 1;
      }
    }
  }
  for (Eigen::Index i = 0; i < sum.cols(); ++i) {
    sum.col(i) *= count(i) > 0 ? 1 / count(i) : kNaN;
  }
  return sum;
}

Eigen::Vector3d findForward(const GaitMotion& motion) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const FootMotion* foot : {&motion.right, &motion.left}) {
    for (Eigen::Index i = 0; i < foot->heel.cols(); ++i) {
      const Eigen::Vector3d along = foot->toe.col(i) - foot->heel.col(i);
      if (along.allFinite()) {
        sum += along;
      }
    }
  }
  sum.y() = 0;
  return sum.norm() > 0 ? sum.normalized().eval() : Eigen::Vector3d::UnitX().eval();
}

}  // namespace

Foot findFootOfMarker(const std::string& marker) {
  return readFootMarker(marker).first;
}

GaitMarkers findGaitMarkers(const std::vector<std::string>& names) {
  GaitMarkers found;
  for (const int rank : {1, 2, 3}) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto [side, part] = readFootMarker(names[i]);
      if (side == Foot::kUnknown) {
        continue;
      }
      FootMarkers& foot = side == Foot::kRight ? found.right : found.left;
      if (part->heel == rank) {
        foot.heel.push_back(static_cast<int>(i));
      }
      if (part->toe == rank) {
        foot.toe.push_back(static_cast<int>(i));
      }
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (isOnPelvis(names[i])) {
      found.pelvis.push_back(static_cast<int>(i));
    }
  }
  return found;
}

double FootMotion::calcDistance(const Eigen::Vector3d& point, int frame) const {
  Eigen::Vector3d along = toe.col(frame) - heel.col(frame);
  Eigen::Vector3d offset = point - heel.col(frame);
  along.y() = 0;
  offset.y() = 0;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp(offset.dot(along) / length, 0.0, 1.0) : 0.0;
  return (offset - share * along).norm();
}

int GaitMotion::findFrame(double t) const {
  if (time.empty() || t < time.front() || t > time.back()) {
    return -1;
  }
  const auto above = std::lower_bound(time.begin(), time.end(), t);
  const auto frame = static_cast<int>(above - time.begin());
  return frame > 0 && t - *(above - 1) < *above - t ? frame - 1 : frame;
}

GaitMotion makeGaitMotion(const MarkerTrajectories& markers, const GaitMarkers& chosen) {
  GaitMotion motion;
  motion.time = markers.time;
  motion.right = makeFoot(markers, chosen.right);
  motion.left = makeFoot(markers, chosen.left);
  motion.pelvis = makeCenter(markers, chosen.pelvis);
  motion.forward = findForward(motion);
  return motion;
}

}  // namespace gaitmill
