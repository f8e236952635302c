#include "core/figure/muscle_names.h"

#include <algorithm>
#include <cctype>

namespace gaitmill {

const char* groupName(MuscleGroup group) {
  switch (group) {
    case MuscleGroup::kGluteals:
      return "Gluteals";
    case MuscleGroup::kHamstrings:
      return "Hamstrings";
    case MuscleGroup::kQuadriceps:
      return "Quadriceps";
    case MuscleGroup::kPlantarflexors:
      return "Plantarflexors";
    case MuscleGroup::kDorsiflexors:
      return "Dorsiflexors";
    case MuscleGroup::kAdductors:
      return "Adductors";
    case MuscleGroup::kHipFlexors:
      return "Hip flexors";
    case MuscleGroup::kOthers:
      return "Others";
  }
  return "";
}

SidedName splitSide(const std::string& name) {
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const std::string mark = std::string("_") + sideLetter(side);
    for (std::size_t place = name.find(mark); place != std::string::npos;
         place = name.find(mark, place + 1)) {
      const std::size_t end = place + mark.size();
      if (place > 0 && (end == name.size() || name[end] == '_')) {
        return {name.substr(0, place) + name.substr(end), side};
      }
    }
  }
  return {name, Side::kNone};
}

const char* sideLetter(Side side) {
  return side == Side::kNone ? "" : side == Side::kRight ? "r" : "l";
}

const char* sideWord(Side side) {
  return side == Side::kNone ? "" : side == Side::kRight ? "right" : "left";
}

const std::vector<MuscleName>& knownMuscles() {
  static const std::vector<MuscleName> names = {
      {"glmax1", "Gluteus maximus, superior", MuscleGroup::kGluteals},
      {"glmax2", "Gluteus maximus, middle", MuscleGroup::kGluteals},
      {"glmax3", "Gluteus maximus, inferior", MuscleGroup::kGluteals},
      {"glmed1", "Gluteus medius, anterior", MuscleGroup::kGluteals},
      {"glmed2", "Gluteus medius, middle", MuscleGroup::kGluteals},
      {"glmed3", "Gluteus medius, posterior", MuscleGroup::kGluteals},
      {"glmin1", "Gluteus minimus, anterior", MuscleGroup::kGluteals},
      {"glmin2", "Gluteus minimus, middle", MuscleGroup::kGluteals},
      {"glmin3", "Gluteus minimus, posterior", MuscleGroup::kGluteals},
      {"bflh", "Biceps femoris, long head", MuscleGroup::kHamstrings},
      {"bfsh", "Biceps femoris, short head", MuscleGroup::kHamstrings},
      {"semimem", "Semimembranosus", MuscleGroup::kHamstrings},
      {"semiten", "Semitendinosus", MuscleGroup::kHamstrings},
      {"recfem", "Rectus femoris", MuscleGroup::kQuadriceps},
      {"vasint", "Vastus intermedius", MuscleGroup::kQuadriceps},
      {"vaslat", "Vastus lateralis", MuscleGroup::kQuadriceps},
      {"vasmed", "Vastus medialis", MuscleGroup::kQuadriceps},
      {"gaslat", "Gastrocnemius, lateral", MuscleGroup::kPlantarflexors},
      {"gasmed", "Gastrocnemius, medial", MuscleGroup::kPlantarflexors},
      {"soleus", "Soleus", MuscleGroup::kPlantarflexors},
      {"tibpost", "Tibialis posterior", MuscleGroup::kPlantarflexors},
      {"fdl", "Flexor digitorum longus", MuscleGroup::kPlantarflexors},
      {"fhl", "Flexor hallucis longus", MuscleGroup::kPlantarflexors},
      {"perbrev", "Peroneus brevis", MuscleGroup::kPlantarflexors},
      {"perlong", "Peroneus longus", MuscleGroup::kPlantarflexors},
      {"tibant", "Tibialis anterior", MuscleGroup::kDorsiflexors},
      {"edl", "Extensor digitorum longus", MuscleGroup::kDorsiflexors},
      {"ehl", "Extensor hallucis longus", MuscleGroup::kDorsiflexors},
      {"addbrev", "Adductor brevis", MuscleGroup::kAdductors},
      {"addlong", "Adductor longus", MuscleGroup::kAdductors},
      {"addmagDist", "Adductor magnus, distal", MuscleGroup::kAdductors},
      {"addmagIsch", "Adductor magnus, ischial", MuscleGroup::kAdductors},
      {"addmagMid", "Adductor magnus, middle", MuscleGroup::kAdductors},
      {"addmagProx", "Adductor magnus, proximal", MuscleGroup::kAdductors},
      {"grac", "Gracilis", MuscleGroup::kAdductors},
      {"iliacus", "Iliacus", MuscleGroup::kHipFlexors},
      {"psoas", "Psoas", MuscleGroup::kHipFlexors},
      {"sart", "Sartorius", MuscleGroup::kHipFlexors},
      {"tfl", "Tensor fasciae latae", MuscleGroup::kHipFlexors},
      {"piri", "Piriformis", MuscleGroup::kOthers},
  };
  return names;
}

MuscleName findMuscleName(const std::string& base) {
  for (const MuscleName& known : knownMuscles()) {
    if (known.base == base) {
      return known;
    }
  }
  MuscleName other{base, base, MuscleGroup::kOthers};
  std::replace(other.display.begin(), other.display.end(), '_', ' ');
  if (!other.display.empty()) {
    other.display.front() =
        static_cast<char>(std::toupper(static_cast<unsigned char>(other.display.front())));
  }
  return other;
}

}  // namespace gaitmill
