#include "core/scale/motion_fit_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/error.h"

namespace gaitmill {

namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Entries of the lower triangle before row r.
int triangle(int r) {
  return r * (r + 1) / 2;
}

}  // namespace

MotionFitProgram::MotionFitProgram(const ModelSpec& generic, const MotionFitData& data)
    : data_(data),
      markers_(generic, data.groups, data.markers),
      free_(markers_.model()),
      movers_(markers_.model(), free_),
      pose_(markers_.model().coordinateCount()),
      moments_(3, markers_.model().coordinateCount()) {
  check(data.offset_deviations.size() == data.markers.size() &&
            data.weights.size() == data.markers.size() && data.pose_lower.size() == free_.count() &&
            data.size_lower.size() == groupCount(),
        "MotionFitProgram: data of another size");
  shared_ = groupCount();
  for (const double deviation : data.offset_deviations) {
    offset_starts_.push_back(deviation > 0 ? shared_ : -1);
    shared_ += deviation > 0 ? 3 : 0;
  }
  findLocalColumns();
  makePattern();
  gradient_.resize(variableCount());
  hessian_.resize(static_cast<Eigen::Index>(pattern_.size()));
}

int MotionFitProgram::offsetStart(int marker) const {
  return offset_starts_[at(marker)];
}

void MotionFitProgram::findLocalColumns() {
  for (int m = 0; m < markers_.markerCount(); ++m) {
    std::vector<int> columns;
    std::vector<int> places;
    for (const Mover& mover : movers_.of(markers_.body(m))) {
      const auto found = std::find(columns.begin(), columns.end(), mover.free);
      places.push_back(static_cast<int>(std::distance(columns.begin(), found)));
      if (found == columns.end()) {
        columns.push_back(mover.free);
      }
    }
    local_.push_back(std::move(columns));
    local_of_.push_back(std::move(places));
  }
}

// Sizes x sizes, offsets x sizes, the diagonal of the offsets, then per frame poses x poses, poses
// x sizes, poses x offsets of the markers that they move.
void MotionFitProgram::makePattern() {
  const int groups = groupCount();
  const auto addTriangle = [&](int start, int n) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j) {
        pattern_.push_back({start + i, start + j});
      }
    }
  };
  addTriangle(0, groups);
  offset_size_begin_ = static_cast<int>(pattern_.size());
  for (int row = groups; row < shared_; ++row) {
    for (int g = 0; g < groups; ++g) {
      pattern_.push_back({row, g});
    }
  }
  offset_offset_begin_ = static_cast<int>(pattern_.size());
  for (int row = groups; row < shared_; ++row) {
    pattern_.push_back({row, row});
  }
  frames_begin_ = static_cast<int>(pattern_.size());
  for (int k = 0; k < frameCount(); ++k) {
    const int start = poseStart(k);
    const auto begin = pattern_.size();
    addTriangle(start, free_.count());
    pose_size_begin_ = static_cast<int>(pattern_.size() - begin);
    for (int f = 0; f < free_.count(); ++f) {
      for (int g = 0; g < groups; ++g) {
        pattern_.push_back({start + f, g});
      }
    }
    pose_offset_begins_.clear();
    for (int m = 0; m < markers_.markerCount(); ++m) {
      pose_offset_begins_.push_back(static_cast<int>(pattern_.size() - begin));
      for (std::size_t l = 0; offsetStart(m) >= 0 && l < local_[at(m)].size(); ++l) {
        for (int axis = 0; axis < 3; ++axis) {
          pattern_.push_back({start + local_[at(m)][l], offsetStart(m) + axis});
        }
      }
    }
    frame_entries_ = static_cast<int>(pattern_.size() - begin);
  }
}

double& MotionFitProgram::sizeSize(int g, int h) {
  return hessian_[triangle(std::max(g, h)) + std::min(g, h)];
}
double& MotionFitProgram::offsetSize(int marker, int axis, int g) {
  const int row = offsetStart(marker) - groupCount() + axis;
  return hessian_[offset_size_begin_ + row * groupCount() + g];
}
double& MotionFitProgram::offsetOffset(int marker, int axis) {
  return hessian_[offset_offset_begin_ + offsetStart(marker) - groupCount() + axis];
}
double& MotionFitProgram::posePose(int frame, int f, int h) {
  return hessian_[frames_begin_ + frame * frame_entries_ + triangle(std::max(f, h)) +
                  std::min(f, h)];
}
double& MotionFitProgram::poseSize(int frame, int f, int g) {
  return hessian_[frames_begin_ + frame * frame_entries_ + pose_size_begin_ + f * groupCount() + g];
}
double& MotionFitProgram::poseOffset(int frame, int marker, int local, int axis) {
  return hessian_[frames_begin_ + frame * frame_entries_ + pose_offset_begins_[at(marker)] +
                  3 * local + axis];
}

void MotionFitProgram::getBounds(Eigen::Ref<Eigen::VectorXd> lower,
                                 Eigen::Ref<Eigen::VectorXd> upper) const {
  lower.setConstant(-std::numeric_limits<double>::infinity());
  upper.setConstant(std::numeric_limits<double>::infinity());
  lower.head(groupCount()) = data_.size_lower;
  upper.head(groupCount()) = data_.size_upper;
  for (int k = 0; k < frameCount(); ++k) {
    lower.segment(poseStart(k), free_.count()) = data_.pose_lower;
    upper.segment(poseStart(k), free_.count()) = data_.pose_upper;
  }
}

void MotionFitProgram::setFrame(const Eigen::Ref<const Eigen::VectorXd>& x, int frame) {
  free_.expandPose(x.segment(poseStart(frame), free_.count()), pose_);
  markers_.setPose(pose_);
}

bool MotionFitProgram::isMeasured(int frame, int marker) const {
  return data_.measured[at(frame)].col(marker).allFinite();
}

Eigen::Vector3d MotionFitProgram::calcResidual(const Eigen::Ref<const Eigen::VectorXd>& x,
                                               int frame,
                                               int marker) const {
  Eigen::Vector3d position = markers_.base(marker);
  for (const int g : markers_.groups(marker)) {
    position += x[g] * markers_.column(g, marker);
  }
  if (offsetStart(marker) >= 0) {
    position += markers_.rotation(markers_.body(marker)) * x.segment<3>(offsetStart(marker));
  }
  return position - data_.measured[at(frame)].col(marker);
}

double MotionFitProgram::calcObjective(const Eigen::Ref<const Eigen::VectorXd>& x) {
  double objective = calcPriors(x);
  for (int k = 0; k < frameCount(); ++k) {
    setFrame(x, k);
    for (int m = 0; m < markers_.markerCount(); ++m) {
      if (isMeasured(k, m)) {
        objective += 0.5 * data_.weights[at(m)] * calcResidual(x, k, m).squaredNorm();
      }
    }
  }
  return objective;
}

double MotionFitProgram::calcPriors(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  double objective = 0;
  for (const SizePrior& prior : data_.size_priors) {
    double value = -prior.mean;
    for (std::size_t i = 0; i < prior.groups.size(); ++i) {
      value += prior.coefficients[i] * x[prior.groups[i]];
    }
    objective += 0.5 * value * value / (prior.deviation * prior.deviation);
  }
  for (int m = 0; m < markers_.markerCount(); ++m) {
    if (offsetStart(m) >= 0) {
      const double deviation = data_.offset_deviations[at(m)];
      objective += 0.5 * x.segment<3>(offsetStart(m)).squaredNorm() / (deviation * deviation);
    }
  }
  for (int k = 0; k < frameCount(); ++k) {
    const auto distance = x.segment(poseStart(k), free_.count()) - data_.pose_mean;
    objective += 0.5 * distance.cwiseAbs2().dot(data_.pose_weights);
  }
  return objective;
}

void MotionFitProgram::calcGradient(const Eigen::Ref<const Eigen::VectorXd>& x,
                                    Eigen::Ref<Eigen::VectorXd> gradient) {
  linearize(x);
  gradient = gradient_;
}

void MotionFitProgram::calcHessian(const Eigen::Ref<const Eigen::VectorXd>& x,
                                   double objective_factor,
                                   const Eigen::Ref<const Eigen::VectorXd>&,
                                   Eigen::Ref<Eigen::VectorXd> values) {
  linearize(x);
  values = objective_factor * hessian_;
}

// Gradient and Hessian in one go: kinematics cost more than either.
void MotionFitProgram::linearize(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (linearized_at_.size() == x.size() && linearized_at_ == x) {
    return;
  }
  gradient_.setZero();
  hessian_.setZero();
  for (int k = 0; k < frameCount(); ++k) {
    setFrame(x, k);
    moments_.setZero();
    for (int m = 0; m < markers_.markerCount(); ++m) {
      if (isMeasured(k, m)) {
        linearizeMarker(x, k, m);
        addGradient(k, m);
        addGaussNewton(k, m);
        addMixedCurvature(k, m);
      }
    }
    addPoseCurvature(k);
  }
  addPriors(x);
  linearized_at_ = x;
}

void MotionFitProgram::linearizeMarker(const Eigen::Ref<const Eigen::VectorXd>& x,
                                       int frame,
                                       int marker) {
  work_.residual = calcResidual(x, frame, marker);
  const Eigen::Vector3d p_GM = work_.residual + data_.measured[at(frame)].col(marker);
  const std::vector<int>& groups = markers_.groups(marker);
  work_.sizes.resize(3, static_cast<Eigen::Index>(groups.size()));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    work_.sizes.col(static_cast<Eigen::Index>(i)) = markers_.column(groups[i], marker);
  }
  work_.poses.setZero(3, static_cast<Eigen::Index>(local_[at(marker)].size()));
  const std::vector<Mover>& movers = movers_.of(markers_.body(marker));
  for (std::size_t a = 0; a < movers.size(); ++a) {
    const int c = movers[a].coordinate;
    Eigen::Vector3d velocity = markers_.baseScrews().col(c).tail<3>();
    for (const int g : groups) {
      velocity += x[g] * markers_.screwColumn(g, c);
    }
    velocity += Eigen::Vector3d(markers_.baseScrews().col(c).head<3>()).cross(p_GM);
    work_.poses.col(local_of_[at(marker)][a]) += movers[a].slope * velocity;
    moments_.col(c) += data_.weights[at(marker)] * velocity.cross(work_.residual);
  }
}

void MotionFitProgram::addGradient(int frame, int marker) {
  const Eigen::Vector3d pull = data_.weights[at(marker)] * work_.residual;
  const std::vector<int>& groups = markers_.groups(marker);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    gradient_[groups[i]] += work_.sizes.col(static_cast<Eigen::Index>(i)).dot(pull);
  }
  if (offsetStart(marker) >= 0) {
    gradient_.segment<3>(offsetStart(marker)) +=
        markers_.rotation(markers_.body(marker)).transpose() * pull;
  }
  for (std::size_t l = 0; l < local_[at(marker)].size(); ++l) {
    gradient_[poseStart(frame) + local_[at(marker)][l]] +=
        work_.poses.col(static_cast<Eigen::Index>(l)).dot(pull);
  }
}

// w J'J of one marker; R'R = 1 makes its offsets' own block diagonal.
void MotionFitProgram::addGaussNewton(int frame, int marker) {
  const double w = data_.weights[at(marker)];
  const std::vector<int>& groups = markers_.groups(marker);
  const std::vector<int>& columns = local_[at(marker)];
  const bool moves = offsetStart(marker) >= 0;
  const Eigen::Matrix3d& R = markers_.rotation(markers_.body(marker));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto size = work_.sizes.col(static_cast<Eigen::Index>(i));
    for (std::size_t j = 0; j <= i; ++j) {
      sizeSize(groups[i], groups[j]) += w * size.dot(work_.sizes.col(static_cast<Eigen::Index>(j)));
    }
    for (int axis = 0; moves && axis < 3; ++axis) {
      offsetSize(marker, axis, groups[i]) += w * size.dot(R.col(axis));
    }
    for (std::size_t l = 0; l < columns.size(); ++l) {
      poseSize(frame, columns[l], groups[i]) +=
          w * size.dot(work_.poses.col(static_cast<Eigen::Index>(l)));
    }
  }
  for (std::size_t l = 0; l < columns.size(); ++l) {
    const auto pose = work_.poses.col(static_cast<Eigen::Index>(l));
    for (std::size_t k = 0; k <= l; ++k) {
      posePose(frame, columns[l], columns[k]) +=
          w * pose.dot(work_.poses.col(static_cast<Eigen::Index>(k)));
    }
    for (int axis = 0; moves && axis < 3; ++axis) {
      poseOffset(frame, marker, static_cast<int>(l), axis) += w * pose.dot(R.col(axis));
    }
  }
  for (int axis = 0; moves && axis < 3; ++axis) {
    offsetOffset(marker, axis) += w;
  }
}

// w r.d2x/dq ds and w r.d2x/dq dd: columns of x turn, and screws grow, with sizes and offsets.
void MotionFitProgram::addMixedCurvature(int frame, int marker) {
  const Eigen::Vector3d pull = data_.weights[at(marker)] * work_.residual;
  const std::vector<int>& groups = markers_.groups(marker);
  const std::vector<Mover>& movers = movers_.of(markers_.body(marker));
  const Eigen::Matrix3d& R = markers_.rotation(markers_.body(marker));
  for (std::size_t a = 0; a < movers.size(); ++a) {
    const int c = movers[a].coordinate;
    // r.(w x v) = (r x w).v
    const Eigen::Vector3d lever =
        movers[a].slope * pull.cross(Eigen::Vector3d(markers_.baseScrews().col(c).head<3>()));
    for (std::size_t i = 0; i < groups.size(); ++i) {
      poseSize(frame, movers[a].free, groups[i]) +=
          movers[a].slope * pull.dot(markers_.screwColumn(groups[i], c)) +
          lever.dot(work_.sizes.col(static_cast<Eigen::Index>(i)));
    }
    for (int axis = 0; offsetStart(marker) >= 0 && axis < 3; ++axis) {
      poseOffset(frame, marker, local_of_[at(marker)][a], axis) += lever.dot(R.col(axis));
    }
  }
}

// sum_m w_m r_m.d2x_m/dq_j dq_k = w_j . sum_m w_m (dx_m/dq_k x r_m) for j proximal to k.
void MotionFitProgram::addPoseCurvature(int frame) {
  for (const auto& [j, k] : movers_.proximalPairs()) {
    const Mover& proximal = movers_.all()[j];
    const Mover& distal = movers_.all()[k];
    const double curvature = proximal.slope * distal.slope *
                             markers_.baseScrews()
                                 .col(proximal.coordinate)
                                 .head<3>()
                                 .dot(moments_.col(distal.coordinate));
    const bool twice = proximal.free == distal.free && j != k;
    posePose(frame, proximal.free, distal.free) += twice ? 2 * curvature : curvature;
  }
}

void MotionFitProgram::addPriors(const Eigen::Ref<const Eigen::VectorXd>& x) {
  for (const SizePrior& prior : data_.size_priors) {
    const double weight = 1 / (prior.deviation * prior.deviation);
    double value = -prior.mean;
    for (std::size_t i = 0; i < prior.groups.size(); ++i) {
      value += prior.coefficients[i] * x[prior.groups[i]];
    }
    for (std::size_t i = 0; i < prior.groups.size(); ++i) {
      gradient_[prior.groups[i]] += weight * prior.coefficients[i] * value;
      for (std::size_t j = 0; j <= i; ++j) {
        sizeSize(prior.groups[i], prior.groups[j]) +=
            weight * prior.coefficients[i] * prior.coefficients[j];
      }
    }
  }
  for (int m = 0; m < markers_.markerCount(); ++m) {
    if (offsetStart(m) >= 0) {
      const double weight = 1 / (data_.offset_deviations[at(m)] * data_.offset_deviations[at(m)]);
      gradient_.segment<3>(offsetStart(m)) += weight * x.segment<3>(offsetStart(m));
      for (int axis = 0; axis < 3; ++axis) {
        offsetOffset(m, axis) += weight;
      }
    }
  }
  for (int k = 0; k < frameCount(); ++k) {
    for (int f = 0; f < free_.count(); ++f) {
      const int place = poseStart(k) + f;
      gradient_[place] += data_.pose_weights[f] * (x[place] - data_.pose_mean[f]);
      posePose(k, f, f) += data_.pose_weights[f];
    }
  }
}

Eigen::MatrixXd MotionFitProgram::calcErrors(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::MatrixXd errors = Eigen::MatrixXd::Constant(
      frameCount(), markers_.markerCount(), std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < frameCount(); ++k) {
    setFrame(x, k);
    for (int m = 0; m < markers_.markerCount(); ++m) {
      if (isMeasured(k, m)) {
        errors(k, m) = calcResidual(x, k, m).norm();
      }
    }
  }
  return errors;
}

}  // namespace gaitmill
