#pragma once

#include <map>
#include <ostream>
#include <string>

#include "service/draw_task.h"

namespace gaitmill {

/// `gaitmill render`: an image of a motion, from the folder that `gaitmill run` leaves or from
/// files.
struct RenderOptions {
  std::string results;        ///< folder; empty = the files below
  std::string model;          ///< .osim
  std::string motion;         ///< coordinates, MOT or STO
  std::string muscle_values;  ///< table that muscles are coloured by; empty = none
  std::string out;            ///< .png or .webp
  std::string geometry;       ///< folder of meshes; empty = stylised bones
  /// As the query of /v1/jobs/{id}/images: "time", "percent", "width", "view", ...
  std::map<std::string, std::string> parameters;
};

/// Draws and writes the image: an animation if its name ends in .webp, a strip if "poses" is given,
/// else one pose.
/// @param report  one line: what was written
/// @throws Error of the readers; kRequestField naming the option; kInputMissing; kRender
void renderFiles(const RenderOptions& options, const Drawing& draw, std::ostream& report);

}  // namespace gaitmill
