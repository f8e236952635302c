#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Muscles that act alike, in the order in which figures show them.
enum class MuscleGroup {
  kGluteals,
  kHamstrings,
  kQuadriceps,
  kPlantarflexors,
  kDorsiflexors,
  kAdductors,
  kHipFlexors,
  kOthers,
};

/// "Gluteals", "Hip flexors"
const char* groupName(MuscleGroup group);

enum class Side { kRight, kLeft, kNone };

/// What stands before "_r" or "_l" in a name, and the side.
struct SidedName {
  std::string base;
  Side side = Side::kNone;
};

/// "soleus_r" is the right "soleus"; the letter may stand between, as in "knee_angle_r_moment".
SidedName splitSide(const std::string& name);
/// "r", "l" or "".
const char* sideLetter(Side side);
/// "right", "left" or "".
const char* sideWord(Side side);

/// How a muscle is called in figures.
struct MuscleName {
  std::string base;     ///< "glmax1"
  std::string display;  ///< "Gluteus maximus, superior"
  MuscleGroup group = MuscleGroup::kOthers;
};

/// The muscle of a leg by its name without side. Of models with other names: the name itself, with
/// spaces for underscores and a capital, among the others.
MuscleName findMuscleName(const std::string& base);

/// The names without side of the model of Rajagopal et al. (2016), in the order of their groups.
const std::vector<MuscleName>& knownMuscles();

}  // namespace gaitmill
