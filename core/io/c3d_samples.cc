#include "core/io/c3d_samples.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One way to store values: how many bytes, and how they become numbers.
template <C3dProcessor kProcessor>
struct IntegerValues {
  static constexpr std::size_t kSize = 2;
  static double read(const char* at) {
    return static_cast<std::int16_t>(c3d::readWord<kProcessor>(at));
  }
  static double readUnsigned(const char* at) { return c3d::readWord<kProcessor>(at); }
};

template <C3dProcessor kProcessor>
struct RealValues {
  static constexpr std::size_t kSize = 4;
  static double read(const char* at) { return static_cast<double>(c3d::readReal<kProcessor>(at)); }
  static double readUnsigned(const char* at) { return read(at); }
};

/// Whether the fourth value of a point says that it was not seen. Reals stand for the same word;
/// one beyond 32767 has its sign bit set, too.
bool isInvalid(double fourth) {
  return fourth < 0 || fourth > 32767;
}

template <class Values>
class SampleReader {
 public:
  SampleReader(const C3dBytes& file,
               const C3dLayout& layout,
               const std::vector<int>& columns,
               const C3dAnalogScale& scale)
      : at_(file.all().data() + layout.data_begin),
        layout_(layout),
        columns_(columns),
        scale_(scale),
        point_factor_(layout.storage == C3dStorage::kInteger ? layout.point_scale : 1.0) {
    samples_.points.resize(layout.frame_count, static_cast<Eigen::Index>(3 * columns.size()));
    samples_.analog.resize(Eigen::Index{layout.frame_count} * layout.subframe_count,
                           layout.channel_count);
    samples_.zero_counts.assign(columns.size(), 0);
  }

  C3dSamples read() {
    for (int frame = 0; frame < layout_.frame_count; ++frame) {
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        readPoint(frame, i);
      }
      at_ += Values::kSize * 4 * static_cast<std::size_t>(layout_.point_count);
      for (int i = 0; i < layout_.subframe_count && layout_.channel_count > 0; ++i) {
        readSubframe(Eigen::Index{frame} * layout_.subframe_count + i);
      }
    }
    return std::move(samples_);
  }

 private:
  void readPoint(int frame, std::size_t i) {
    const char* const at = at_ + Values::kSize * 4 * static_cast<std::size_t>(columns_[i]);
    const double x = Values::read(at);
    const double y = Values::read(at + Values::kSize);
    const double z = Values::read(at + 2 * Values::kSize);
    const bool invalid = isInvalid(Values::read(at + 3 * Values::kSize));
    const bool zero = x == 0 && y == 0 && z == 0;
    samples_.zero_counts[i] += zero && !invalid ? 1 : 0;
    double* const to = &samples_.points(frame, static_cast<Eigen::Index>(3 * i));
    if (invalid || zero || !std::isfinite(x + y + z)) {
      to[0] = to[1] = to[2] = kNaN;
    } else {
      to[0] = x * point_factor_;
      to[1] = y * point_factor_;
      to[2] = z * point_factor_;
    }
  }

  void readSubframe(Eigen::Index row) {
    double* const to = &samples_.analog(row, 0);
    const bool is_unsigned = scale_.integers == C3dAnalogScale::Integers::kUnsigned;
    const auto count = static_cast<std::size_t>(layout_.channel_count);
    for (std::size_t i = 0; i < count; ++i, at_ += Values::kSize) {
      const double raw = is_unsigned ? Values::readUnsigned(at_) : Values::read(at_);
      to[i] = (raw - scale_.offset[i]) * scale_.scale[i];
    }
  }

  const char* at_;
  const C3dLayout& layout_;
  const std::vector<int>& columns_;
  const C3dAnalogScale& scale_;
  double point_factor_;
  C3dSamples samples_;
};

template <C3dProcessor kProcessor>
C3dSamples readOf(const C3dBytes& file,
                  const C3dLayout& layout,
                  const std::vector<int>& columns,
                  const C3dAnalogScale& scale) {
  if (layout.storage == C3dStorage::kInteger) {
    return SampleReader<IntegerValues<kProcessor>>(file, layout, columns, scale).read();
  }
  return SampleReader<RealValues<kProcessor>>(file, layout, columns, scale).read();
}

}  // namespace

C3dSamples readC3dSamples(const C3dBytes& file,
                          const C3dLayout& layout,
                          const std::vector<int>& columns,
                          const C3dAnalogScale& scale) {
  switch (file.processor()) {
    case C3dProcessor::kIntel:
      return readOf<C3dProcessor::kIntel>(file, layout, columns, scale);
    case C3dProcessor::kDec:
      return readOf<C3dProcessor::kDec>(file, layout, columns, scale);
    case C3dProcessor::kMips:
      break;
  }
  return readOf<C3dProcessor::kMips>(file, layout, columns, scale);
}

}  // namespace gaitmill
