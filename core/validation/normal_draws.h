#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace gaitmill {

/// Independent standard normal deviates, the same sequence on every machine: pairs of 53-bit
/// uniforms of std::mt19937_64 by the polar method (Marsaglia and Bray 1964), whose accepting of a
/// pair does not depend on the rounding of a library function. (std::normal_distribution differs
/// between libraries; core/sample's Noise has cut tails, which a Monte Carlo of spreads would
/// show.)
class NormalDraws {
 public:
  explicit NormalDraws(std::uint64_t seed) : bits_(seed) {}

  double draw() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0;
    double v = 0;
    double s = 0;
    do {
      u = drawBetweenMinusOneAndOne();
      v = drawBetweenMinusOneAndOne();
      s = u * u + v * v;
    } while (s >= 1 || s == 0);
    const double factor = std::sqrt(-2 * std::log(s) / s);
    spare_ = v * factor;
    has_spare_ = true;
    return u * factor;
  }

 private:
  double drawBetweenMinusOneAndOne() { return static_cast<double>(bits_() >> 11) * 0x1p-52 - 1.0; }

  std::mt19937_64 bits_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace gaitmill
