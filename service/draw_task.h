#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/data/figure.h"
#include "core/data/time_series.h"
#include "core/render/picture.h"

namespace gaitmill {

/// One thing that the process that draws is asked for.
struct DrawTask {
  enum class Kind { kPose, kStrip, kAnimation, kListValidations, kValidation };
  Kind kind = Kind::kPose;

  double start = 0;  ///< [s] of a strip or an animation; the time of a pose
  double end = 0;    ///< [s]
  int poses = 1;
  double rate = 25;
  double slow_down = 1;
  PictureOptions options;

  std::string figure;      ///< of a validation
  std::uint64_t seed = 1;  ///< of its random draws
};

/// What a task is done with: for validations the model alone.
struct DrawData {
  std::string model_name;  ///< for messages
  PictureData picture;
};

/// Does tasks one after the other and may keep what the last one took to prepare. Results of
/// validations are figures as by encodeFigures().
using Drawing = std::function<Picture(const DrawTask& task, const DrawData& data)>;

// Between processes: JSON text, and byte strings by name.
std::string encodeDrawTask(const DrawTask& task);
/// @throws Error kInternal if the text is no task
DrawTask decodeDrawTask(const std::string& text);
std::map<std::string, std::string> encodeDrawData(const DrawData& data);
/// @throws Error kStorage if a table is none
DrawData decodeDrawData(std::map<std::string, std::string> parts);

/// Figures as JSON text and back, every double bit by bit; what is not finite comes back as NaN. Of
/// a FigureInfo the panels are none.
std::string encodeFigures(const std::vector<Figure>& figures);
/// @throws Error kJobCrashed if the text is no figures
std::vector<Figure> decodeFigures(const std::string& text);
inline constexpr const char* kFiguresType = "application/json";

}  // namespace gaitmill
