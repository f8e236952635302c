#pragma once

#include <cstdint>
#include <random>

namespace gaitmill {

/// Normal deviates with mean 0 and standard deviation 1 that are the same bits on every machine:
/// the sum of twelve uniform numbers less six, each 53 bits of std::mt19937_64. The sum's tails end
/// at six standard deviations. (std::normal_distribution differs between libraries.)
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : bits_(seed) {}

  double draw() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += static_cast<double>(bits_() >> 11) * 0x1p-53;
    }
    return sum;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace gaitmill
