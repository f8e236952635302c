#pragma once

#include <string>

#include "core/figure/result_source.h"
#include "core/render/picture.h"

namespace gaitmill {

/// Name of the model document, among a job's files, that its last motion belongs to.
inline constexpr const char* kMotionModel = "adjusted_model.osim";

/// "activation", "force", "fiber_length"; any other word is none.
MuscleColor parseMuscleColor(const std::string& color);

/// What pictures of these results are made of; the model's document is left to the caller.
/// @throws Error kResultNotFound, kResultNotReady if there is no motion
PictureData collectPictureData(const ResultSource& results, MuscleColor color);

/// Start and end of the gait cycle as a summary has them [s]; `end` <= `start` if there is none.
struct CycleSpan {
  double start = 0;
  double end = 0;
  bool exists() const { return end > start; }
};
CycleSpan findCycleSpan(const std::string& summary_json);

}  // namespace gaitmill
