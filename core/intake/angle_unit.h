#pragma once

#include <optional>

#include "core/data/decision.h"

namespace gaitmill {

/// What a table says of the unit of its angles.
struct StatedAngles {
  bool degrees = false;
  bool is_stated = false;  ///< by the header; else guessed from the kind of file
};

/// Whether the angles of a coordinate table are degrees. In any movement some joint bends by 9
/// degrees and none by more than 206, so that only one unit can be right.
/// @param peak  largest angle of a rotational coordinate as the file has it
/// @param set   what the settings say
/// @throws Error kInputAmbiguous if the header says what the numbers cannot be
bool decideAngleUnit(double peak,
                     const StatedAngles& stated,
                     const std::optional<bool>& set,
                     Decisions& decisions);

}  // namespace gaitmill
