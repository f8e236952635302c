#include "core/validation/muscle_title.h"

#include "core/figure/muscle_names.h"

namespace gaitmill {

std::string findMuscleBase(const std::string& muscle) {
  const std::size_t n = muscle.size();
  const bool has_side =
      n > 2 && muscle[n - 2] == '_' && (muscle[n - 1] == 'r' || muscle[n - 1] == 'l');
  return has_side ? muscle.substr(0, n - 2) : muscle;
}

std::string makeMuscleTitle(const std::string& muscle) {
  return findMuscleName(findMuscleBase(muscle)).display;
}

std::string makeSidedTitle(const std::string& muscle) {
  if (findMuscleBase(muscle) == muscle) {
    return makeMuscleTitle(muscle);
  }
  return makeMuscleTitle(muscle) + (muscle.back() == 'r' ? " (right)" : " (left)");
}

}  // namespace gaitmill
