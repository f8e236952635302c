#pragma once

#include <cstdint>

#include "api/dto/image.h"
#include "core/data/time_series.h"
#include "service/draw_task.h"
#include "service/picture_data.h"

namespace gaitmill {

/// What is to be drawn for a request: times that were left out are those of the gait cycle, or of
/// the motion where there is none.
/// @throws Error kRequestField for an unknown view, and for a percentage without a cycle;
///         kResultNotFound for a motion without rows
DrawTask makeDrawTask(const api::ImageRequest& request,
                      const TimeSeries& motion,
                      const CycleSpan& cycle);

/// Pixels of a picture over all its poses or frames.
/// @throws Error kImageSize, kRequestField for what a painter does not take
std::int64_t countPixels(const DrawTask& task);

}  // namespace gaitmill
