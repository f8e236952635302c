#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/math/nonlinear_program.h"
#include "core/model/coordinate_movers.h"
#include "core/model/free_coordinates.h"
#include "core/scale/stretched_markers.h"

namespace gaitmill {

/// Belief about sizes before any marker is seen: sum_g coefficients_g s_g = mean +- deviation.
struct SizePrior {
  std::string name;
  std::vector<int> groups;
  std::vector<double> coefficients;
  double mean = 0;
  double deviation = 1;
};

/// Everything a motion fit is given, as numbers.
struct MotionFitData {
  std::vector<ScaleGroup> groups;
  std::vector<std::string> markers;
  /// Per marker: standard deviation of its offset along each body axis [m]; 0 = it does not move.
  std::vector<double> offset_deviations;
  /// Per frame: (3 x n_markers) [m] in ground, NaN = missing.
  std::vector<Eigen::Matrix3Xd> measured;
  /// Per marker: weight of a squared error in one frame [1/m^2].
  std::vector<double> weights;
  std::vector<SizePrior> size_priors;
  Eigen::VectorXd size_lower, size_upper;  ///< (n_groups)
  Eigen::VectorXd pose_lower, pose_upper;  ///< (n_free) [rad|m]
  /// (n_free) where coordinates rest [rad|m], and the weight of a squared distance in one frame.
  Eigen::VectorXd pose_mean, pose_weights;
};

/// Sizes s, marker offsets d and poses q_k of some frames together:
///   minimise  1/2 sum_k sum_m w_m |x_m(q_k, s, d_m) - y_km|^2 + 1/2 sum_m |d_m|^2 / sigma_m^2
///           + 1/2 sum_p (c_p.s - mean_p)^2 / sigma_p^2 + 1/2 sum_k sum_j v_j (q_kj - q0_j)^2
/// x = [s | d of the movable markers | free coordinates of frame 1 | of frame 2 ...]; frames meet
/// only through s and d, so that the Hessian is an arrow. Gradient exact; Hessian exact but for the
/// second derivatives of the splines of a knee, which come with a residual as their factor.
class MotionFitProgram : public NonlinearProgram {
 public:
  /// Keeps a reference to the data. @throws Error kModelReference
  MotionFitProgram(const ModelSpec& generic, const MotionFitData& data);

  int groupCount() const { return markers_.groupCount(); }
  int frameCount() const { return static_cast<int>(data_.measured.size()); }
  const FreeCoordinates& freeCoordinates() const { return free_; }

  /// Places of the unknowns in x.
  int offsetStart(int marker) const;  ///< of three numbers; -1 if the marker does not move
  int poseStart(int frame) const { return shared_ + frame * free_.count(); }

  int variableCount() const override { return poseStart(frameCount()); }
  void getBounds(Eigen::Ref<Eigen::VectorXd> lower,
                 Eigen::Ref<Eigen::VectorXd> upper) const override;
  double calcObjective(const Eigen::Ref<const Eigen::VectorXd>& x) override;
  void calcGradient(const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> gradient) override;
  std::vector<SparseEntry> hessianPattern() const override { return pattern_; }
  void calcHessian(const Eigen::Ref<const Eigen::VectorXd>& x,
                   double objective_factor,
                   const Eigen::Ref<const Eigen::VectorXd>& multipliers,
                   Eigen::Ref<Eigen::VectorXd> values) override;

  /// Distance of each marker from its measurement, (n_frames x n_markers) [m], NaN where missing.
  Eigen::MatrixXd calcErrors(const Eigen::Ref<const Eigen::VectorXd>& x);

 private:
  using Mover = CoordinateMovers::Mover;
  /// One marker in one frame: position, and derivatives by what it depends on.
  struct Linearized {
    Eigen::Vector3d residual;
    Eigen::Matrix3Xd sizes;  ///< (3 x its groups)
    Eigen::Matrix3Xd poses;  ///< (3 x free coordinates that move it)
  };

  void findLocalColumns();
  void makePattern();

  void setFrame(const Eigen::Ref<const Eigen::VectorXd>& x, int frame);
  bool isMeasured(int frame, int marker) const;
  Eigen::Vector3d calcResidual(const Eigen::Ref<const Eigen::VectorXd>& x,
                               int frame,
                               int marker) const;
  void linearizeMarker(const Eigen::Ref<const Eigen::VectorXd>& x, int frame, int marker);
  void linearize(const Eigen::Ref<const Eigen::VectorXd>& x);
  void addGradient(int frame, int marker);
  void addGaussNewton(int frame, int marker);
  void addMixedCurvature(int frame, int marker);
  void addPoseCurvature(int frame);
  void addPriors(const Eigen::Ref<const Eigen::VectorXd>& x);
  double calcPriors(const Eigen::Ref<const Eigen::VectorXd>& x) const;

  double& sizeSize(int g, int h);
  double& offsetSize(int marker, int axis, int g);
  double& offsetOffset(int marker, int axis);
  double& poseSize(int frame, int f, int g);
  double& poseOffset(int frame, int marker, int local, int axis);
  double& posePose(int frame, int f, int h);

  const MotionFitData& data_;
  StretchedMarkers markers_;
  FreeCoordinates free_;
  CoordinateMovers movers_;
  std::vector<int> offset_starts_;          ///< per marker, -1 = fixed
  std::vector<std::vector<int>> local_;     ///< per marker: free coordinates that move it
  std::vector<std::vector<int>> local_of_;  ///< per marker and mover: its place in local_
  int shared_ = 0;                          ///< number of sizes and offsets
  Eigen::VectorXd pose_;                    ///< (n_coordinates)

  // Where the blocks of the Hessian begin among its values.
  std::vector<SparseEntry> pattern_;
  int offset_size_begin_ = 0, offset_offset_begin_ = 0, frames_begin_ = 0, frame_entries_ = 0;
  int pose_size_begin_ = 0;              ///< within a frame
  std::vector<int> pose_offset_begins_;  ///< within a frame, per marker

  // Of the last point that was linearized.
  Eigen::VectorXd linearized_at_, gradient_, hessian_;
  Linearized work_;
  Eigen::Matrix3Xd moments_;  ///< (3 x n_coordinates) sum w x_c x r
};

}  // namespace gaitmill
