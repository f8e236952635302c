#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/io/c3d_bytes.h"
#include "core/io/c3d_parameters.h"

namespace gaitmill {

// Where the frames of a C3D file lie and what is in them. Internal to core/io.

enum class C3dStorage { kInteger, kReal };

struct C3dLayout {
  std::size_t data_begin = 0;  ///< first byte of the first frame
  int point_count = 0;
  int channel_count = 0;
  int subframe_count = 0;  ///< analog samples of a channel per frame
  int frame_count = 0;     ///< that are in the file, whatever its counts say
  long first_frame = 1;    ///< 1-based number of the first frame in the recording it was cut from
  C3dStorage storage = C3dStorage::kInteger;
  double point_scale = 1;  ///< [length unit of the file] per integer
  double rate = 0;         ///< [Hz] of frames

  std::size_t frameSize() const {
    const std::size_t values =
        4U * static_cast<std::size_t>(point_count) +
        static_cast<std::size_t>(channel_count) * static_cast<std::size_t>(subframe_count);
    return values * (storage == C3dStorage::kReal ? 4U : 2U);
  }
};

/// Settles what header and parameters say of the frames; where they differ, the counts under which
/// the file has the right size win, and a warning says so. A file shorter than its counts is read
/// as far as whole frames go.
/// @throws Error kC3dHeader (no rate, no scale), kC3dData (nothing in a frame, or no whole frame)
C3dLayout findC3dLayout(const C3dBytes& file,
                        const C3dParameters& parameters,
                        const std::string& file_name,
                        std::vector<std::string>& warnings);

}  // namespace gaitmill
