#include "core/math/qp_problem.h"

#include <limits>

namespace gaitmill {

QpProblem::QpProblem(int rows, int columns)
    : A(Eigen::MatrixXd::Zero(rows, columns)),
      c(Eigen::VectorXd::Zero(rows)),
      weight(Eigen::VectorXd::Ones(columns)),
      lower(Eigen::VectorXd::Constant(columns, -std::numeric_limits<double>::infinity())),
      upper(Eigen::VectorXd::Constant(columns, std::numeric_limits<double>::infinity())) {}

}  // namespace gaitmill
