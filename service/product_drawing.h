#pragma once

#include <string>

#include "service/draw_task.h"

namespace gaitmill {

/// Draws with OSMesa and computes validation figures. The painter is made by the first picture.
/// @param geometry  folder of meshes; empty = stylised bones
Drawing makeProductDrawing(const std::string& geometry);

}  // namespace gaitmill
