#pragma once

#include <cstdint>

namespace gaitmill {

/// What one API key (or the local user, whose key id is empty) has stored at present. Deleting
/// trials and jobs gives it back.
struct Usage {
  std::int64_t bytes = 0;   ///< of the files of trials and of catalog documents, as uploaded
  std::int64_t trials = 0;  ///<
  std::int64_t jobs = 0;    ///<
  std::int64_t frames = 0;  ///< sum over jobs
  std::int64_t pixels = 0;  ///< of images, sum over jobs
};

/// The most that one API key may have; 0 = no limit.
struct Quota {
  std::int64_t bytes = 0;
  std::int64_t jobs = 0;
  std::int64_t frames = 0;
  std::int64_t pixels = 0;
};

}  // namespace gaitmill
