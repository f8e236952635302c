#include "core/math/natural_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/where.h"

namespace gaitmill {
namespace {

// The natural spline of degree 2m-1 has an m-th derivative sum_j c_j M_j, M_j the B-spline of
// degree m-1 on knots j..j+m with unit integral. Since the m-th divided difference of any function
// f is integral(M_j f^(m)) / m!, the c_j solve the band system G c = m! f[x_j..x_j+m], G_jk =
// integral M_j M_k. Half the degree rounded up, m, is 2 or 3.
constexpr int kMaxOrder = 3;

// Gauss-Legendre nodes and weights on [0, 1], exact for the quartic products of quadratic
// B-splines.
constexpr std::array<double, 3> kGaussNodes = {0.11270166537925831, 0.5, 0.88729833462074169};
constexpr std::array<double, 3> kGaussWeights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

using Splines = std::array<double, kMaxOrder>;

// The B-splines M_j, j = interval-m+1 .. interval, of order m at x inside the interval; zero where
// one would need knots outside the data.
Splines calcUnitSplines(const std::vector<double>& knots, int order, int interval, double x) {
  const auto knot = [&](int i) {
    return knots[static_cast<std::size_t>(i)];
  };
  const int last = static_cast<int>(knots.size()) - 1;
  Splines value{};
  value[static_cast<std::size_t>(order - 1)] = 1 / (knot(interval + 1) - knot(interval));
  for (int k = 2; k <= order; ++k) {
    // Entry order-1-i is the spline that starts at knot interval-i.
    for (int i = k - 1; i >= 0; --i) {
      const int j = interval - i;
      const auto slot = static_cast<std::size_t>(order - 1 - i);
      if (j < 0 || j + k > last) {
        value[slot] = 0;
        continue;
      }
      const double left = i < k - 1 ? value[slot] : 0;
      const double right = i > 0 ? value[slot + 1] : 0;
      value[slot] = k / (k - 1.0) * ((x - knot(j)) * left + (knot(j + k) - x) * right) /
                    (knot(j + k) - knot(j));
    }
  }
  return value;
}

// Right-hand sides m! f[x_j..x_j+m], one row per j, all columns.
RowMatrix calcDividedDifferences(const std::vector<double>& knots,
                                 const Eigen::Ref<const RowMatrix>& values,
                                 int order) {
  RowMatrix difference = values;
  Eigen::Index rows = values.rows();
  for (int k = 1; k <= order; ++k) {
    --rows;
    for (Eigen::Index j = 0; j < rows; ++j) {
      const double width =
          knots[static_cast<std::size_t>(j + k)] - knots[static_cast<std::size_t>(j)];
      difference.row(j) = (difference.row(j + 1) - difference.row(j)) * (k / width);
    }
  }
  return difference.topRows(rows);
}

// Lower band of the Gram matrix G: band(j, k) = G_j,j-k.
RowMatrix calcGramBand(const std::vector<double>& knots, int order) {
  const int count = static_cast<int>(knots.size()) - order;
  RowMatrix band = RowMatrix::Zero(count, order);
  for (int i = 0; i + 1 < static_cast<int>(knots.size()); ++i) {
    const double start = knots[static_cast<std::size_t>(i)];
    const double width = knots[static_cast<std::size_t>(i) + 1] - start;
    for (std::size_t g = 0; g < kGaussNodes.size(); ++g) {
      const Splines M = calcUnitSplines(knots, order, i, start + kGaussNodes[g] * width);
      for (int a = 0; a < order; ++a) {
        const int j = i - order + 1 + a;
        if (j < 0 || j >= count) continue;
        for (int b = std::max(0, a - j); b <= a; ++b) {
          band(j, a - b) += kGaussWeights[g] * width * M[static_cast<std::size_t>(a)] *
                            M[static_cast<std::size_t>(b)];
        }
      }
    }
  }
  return band;
}

// Solves the positive definite band system in place for all columns of `right` (Cholesky).
void solveBand(RowMatrix& band, RowMatrix& right) {
  const Eigen::Index count = band.rows();
  const Eigen::Index width = band.cols();
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index k = std::min(width - 1, j); k >= 0; --k) {
      double sum = band(j, k);
      for (Eigen::Index l = k + 1; l < width && l <= j; ++l) sum -= band(j, l) * band(j - k, l - k);
      band(j, k) = k == 0 ? std::sqrt(sum) : sum / band(j - k, 0);
    }
    for (Eigen::Index k = 1; k < width && k <= j; ++k)
      right.row(j) -= band(j, k) * right.row(j - k);
    right.row(j) /= band(j, 0);
  }
  for (Eigen::Index j = count - 1; j >= 0; --j) {
    for (Eigen::Index k = 1; k < width && j + k < count; ++k) {
      right.row(j) -= band(j + k, k) * right.row(j + k);
    }
    right.row(j) /= band(j, 0);
  }
}

// The m-th derivative as a polynomial of degree m-1 on every interval: `order` rows per interval,
// its value and derivatives at the interval's start (value, slope, second derivative).
RowMatrix calcDerivativePieces(const std::vector<double>& knots, const RowMatrix& c, int order) {
  const int intervals = static_cast<int>(knots.size()) - 1;
  RowMatrix pieces = RowMatrix::Zero(order * intervals, c.cols());
  RowMatrix sample(order, c.cols());
  for (int i = 0; i < intervals; ++i) {
    const double start = knots[static_cast<std::size_t>(i)];
    const double h = knots[static_cast<std::size_t>(i) + 1] - start;
    sample.setZero();
    for (int s = 0; s < order; ++s) {
      const Splines M = calcUnitSplines(knots, order, i, start + h * s / (order - 1));
      for (int a = 0; a < order; ++a) {
        const int j = i - order + 1 + a;
        if (j >= 0 && j < c.rows()) sample.row(s) += M[static_cast<std::size_t>(a)] * c.row(j);
      }
    }
    auto piece = pieces.middleRows(order * i, order);
    piece.row(0) = sample.row(0);
    if (order == 2) {
      piece.row(1) = (sample.row(1) - sample.row(0)) / h;
    } else {
      piece.row(1) = (4 * sample.row(1) - 3 * sample.row(0) - sample.row(2)) / h;
      piece.row(2) = 4 * (sample.row(0) - 2 * sample.row(1) + sample.row(2)) / (h * h);
    }
  }
  return pieces;
}

void checkTable(const std::vector<double>& time,
                const Eigen::Ref<const RowMatrix>& values,
                int degree) {
  require(degree == 3 || degree == 5, ErrorCode::kTableShape, "spline degree must be 3 or 5");
  require(static_cast<Eigen::Index>(time.size()) == values.rows(),
          ErrorCode::kTableShape,
          "spline needs one row of values per time");
  require(static_cast<int>(time.size()) > degree,
          ErrorCode::kTableShape,
          "spline of degree " + std::to_string(degree) + " needs " + std::to_string(degree + 1) +
              " rows, found " + std::to_string(time.size()));
  for (std::size_t i = 1; i < time.size(); ++i) {
    require(time[i] > time[i - 1],
            ErrorCode::kTableTimeOrder,
            "spline needs strictly increasing times, row " + std::to_string(i + 1) + " repeats " +
                std::to_string(time[i]),
            atTime(time[i]));
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    require(values.row(static_cast<Eigen::Index>(i)).allFinite(),
            ErrorCode::kTableNumber,
            "spline through a value that is not a number",
            atTime(time[i]));
  }
}

// Fills the Taylor coefficients of every interval, each restarted from the data, so that round-off
// does not add up over the record.
class SplineAssembly {
 public:
  SplineAssembly(const std::vector<double>& time,
                 const Eigen::Ref<const RowMatrix>& values,
                 const RowMatrix& pieces,
                 int order,
                 Eigen::Ref<RowMatrix> coefficients)
      : time_(time), values_(values), pieces_(pieces), order_(order), out_(coefficients) {}

  void run() {
    const int last = static_cast<int>(time_.size()) - 1;
    for (int i = 0; i < last; ++i) setUpperCoefficients(i);
    for (int i = 0; i < last; ++i) {
      if (order_ == 2) {
        setCubicSlope(i);
      } else if (i > 0) {
        setQuinticSlopeAndCurvature(i);
      }
    }
    if (order_ == 3) setQuinticStart();
    setContinuation();
  }

 private:
  double width(int i) const {
    return time_[static_cast<std::size_t>(i) + 1] - time_[static_cast<std::size_t>(i)];
  }
  auto coefficient(int interval, int power) { return out_.row(2 * order_ * interval + power); }
  auto piece(int interval, int derivative) const {
    return pieces_.row(order_ * interval + derivative);
  }

  // f_i and what the m-th derivative says: powers m and above.
  void setUpperCoefficients(int i) {
    coefficient(i, 0) = values_.row(i);
    double factorial = order_ == 2 ? 2 : 6;  // of the power
    for (int k = 0; k < order_; ++k) {
      coefficient(i, order_ + k) = piece(i, k) / factorial;
      factorial *= order_ + k + 1;
    }
  }

  void setCubicSlope(int i) {
    const double h = width(i);
    coefficient(i, 1) =
        (values_.row(i + 1) - values_.row(i)) / h - h * (coefficient(i, 2) + h * coefficient(i, 3));
  }

  // Slope a1 and half curvature a2 at knot i from the two neighbouring values:
  //   right = a1 + a2 h1,  left = a1 - a2 h0  once the known powers 3 to 5 are taken off.
  void setQuinticSlopeAndCurvature(int i) {
    const double h0 = width(i - 1);
    const double h1 = width(i);
    const auto a3 = coefficient(i, 3);
    // Left piece about its right end: fourth and fifth power.
    const Eigen::RowVectorXd a4 = (piece(i - 1, 1) + h0 * piece(i - 1, 2)) / 24;
    const auto a5 = piece(i - 1, 2) / 120;
    const Eigen::RowVectorXd right =
        (values_.row(i + 1) - values_.row(i)) / h1 -
        h1 * h1 * (a3 + h1 * (coefficient(i, 4) + h1 * coefficient(i, 5)));
    const Eigen::RowVectorXd left =
        (values_.row(i) - values_.row(i - 1)) / h0 - h0 * h0 * (a3 - h0 * (a4 - h0 * a5));
    coefficient(i, 2) = (right - left) / (h0 + h1);
    coefficient(i, 1) = (h0 * right + h1 * left) / (h0 + h1);
  }

  // Knot 0 has one neighbour: the curvature comes back from knot 1, the slope from the next value.
  void setQuinticStart() {
    const double h = width(0);
    coefficient(0, 2) =
        coefficient(1, 2) -
        h * (3 * coefficient(0, 3) + h * (6 * coefficient(0, 4) + h * 10 * coefficient(0, 5)));
    coefficient(0, 1) =
        (values_.row(1) - values_.row(0)) / h -
        h * (coefficient(0, 2) +
             h * (coefficient(0, 3) + h * (coefficient(0, 4) + h * coefficient(0, 5))));
  }

  // The polynomial of degree m-1 beyond the last knot: value, slope and (quintic) curvature there.
  void setContinuation() {
    const int knot = static_cast<int>(time_.size()) - 1;
    const double h = width(knot - 1);
    coefficient(knot, 0) = values_.row(knot);
    for (int k = 1; k < order_; ++k) {
      double factor = 1;  // binomial(l, k) h^(l-k)
      for (int l = k; l < 2 * order_; ++l) {
        coefficient(knot, k) += factor * coefficient(knot - 1, l);
        factor *= h * (l + 1.0) / (l + 1.0 - k);
      }
    }
  }

  const std::vector<double>& time_;
  const Eigen::Ref<const RowMatrix>& values_;
  const RowMatrix& pieces_;
  const int order_;
  Eigen::Ref<RowMatrix> out_;
};

}  // namespace

NaturalSpline::NaturalSpline(std::vector<double> time,
                             const Eigen::Ref<const RowMatrix>& values,
                             int degree)
    : time_(std::move(time)), columns_(static_cast<int>(values.cols())), degree_(degree) {
  checkTable(time_, values, degree);
  const int order = (degree + 1) / 2;
  RowMatrix band = calcGramBand(time_, order);
  RowMatrix c = calcDividedDifferences(time_, values, order);
  solveBand(band, c);
  const RowMatrix pieces = calcDerivativePieces(time_, c, order);
  // One piece per interval and one more, of degree m-1, that continues beyond the end.
  const auto rows = (degree + 1) * static_cast<Eigen::Index>(time_.size());
  coefficients_.assign(static_cast<std::size_t>(rows * columns_), 0.0);
  Eigen::Map<RowMatrix> coefficients(coefficients_.data(), rows, columns_);
  SplineAssembly(time_, values, pieces, order, coefficients).run();
}

int NaturalSpline::findInterval(double t) const {
  const int last = static_cast<int>(time_.size()) - 1;
  if (t <= time_.front()) return 0;
  if (t >= time_.back()) return last;
  // Right at once on a uniform grid.
  const double fraction = (t - time_.front()) / (time_.back() - time_.front());
  const auto guess = static_cast<std::size_t>(std::min(fraction * last, last - 1.0));
  if (time_[guess] <= t && t < time_[guess + 1]) return static_cast<int>(guess);
  return static_cast<int>(std::upper_bound(time_.begin(), time_.end(), t) - time_.begin()) - 1;
}

void NaturalSpline::evaluate(double t,
                             Eigen::Ref<Eigen::VectorXd> value,
                             Eigen::Ref<Eigen::VectorXd> first,
                             Eigen::Ref<Eigen::VectorXd> second) const {
  const int interval = findInterval(t);
  const double step = t - time_[static_cast<std::size_t>(interval)];
  // Before the first knot only the powers below m continue.
  const int top = step < 0 ? (degree_ - 1) / 2 : degree_;
  const double* piece =
      coefficients_.data() +
      static_cast<std::size_t>(interval) * static_cast<std::size_t>((degree_ + 1) * columns_);
  for (int column = 0; column < columns_; ++column) {
    double f = 0;
    double df = 0;
    double half_ddf = 0;
    for (int k = top; k >= 0; --k) {
      half_ddf = half_ddf * step + df;
      df = df * step + f;
      f = f * step + piece[k * columns_ + column];
    }
    if (value.size() > 0) value(column) = f;
    if (first.size() > 0) first(column) = df;
    if (second.size() > 0) second(column) = 2 * half_ddf;
  }
}

void NaturalSpline::evaluate(double t, Eigen::Ref<Eigen::VectorXd> value) const {
  Eigen::VectorXd none;
  evaluate(t, value, none, none);
}

}  // namespace gaitmill
