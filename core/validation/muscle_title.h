#pragma once

#include <string>

namespace gaitmill {

/// "soleus" of "soleus_r": the name without side.
std::string findMuscleBase(const std::string& muscle);

/// How figures of one leg call a muscle, without its side: "Gluteus maximus, superior".
std::string makeMuscleTitle(const std::string& muscle);

/// The same with its side: "Soleus (right)".
std::string makeSidedTitle(const std::string& muscle);

}  // namespace gaitmill
