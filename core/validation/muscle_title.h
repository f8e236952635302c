#pragma once

#include <string>

namespace gaitmill {

/// "soleus" of "soleus_r": the name without side.
std::string findMuscleBase(const std::string& muscle);

/// How figures of one leg call a muscle, without its side.
std::string makeMuscleTitle(const std::string& muscle);

}  // namespace gaitmill
