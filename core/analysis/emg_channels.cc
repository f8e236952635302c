#include "core/analysis/emg_channels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <sstream>
#include <utility>

namespace gaitmill {

namespace {

using Words = std::vector<std::string>;

/// A muscle that surface or wire electrodes record. All lists are separated by blanks; names
/// without side, lower case, letters and digits only.
struct KnownMuscle {
  const char* abbreviations;  ///< whole names in use
  const char* stems;          ///< words that all must begin some word of the name; may be empty
  const char* muscles;        ///< of the project's own model
  const char* elsewhere;      ///< the same in other public models (gait2392, gait10dof18musc)
};

// Names of more stems come before those of fewer: "gastrocnemius lateralis" is not just any
// gastrocnemius. Abbreviations: those of the published trials, of SENIAM and of common EMG systems.
constexpr std::array<KnownMuscle, 33> kKnownMuscles = {{
    {"gaslat lg gl galat latgas gastrolat gastlat", "gas lat", "gaslat", "latgas"},
    {"gasmed mg gamed medgas gastromed gastmed mgas", "gas med", "gasmed", "medgas"},
    {"gas ga gastroc gastro gastrocs", "gas", "gasmed gaslat", "medgas latgas gastroc"},
    {"sol so", "sol", "soleus", ""},
    {"ta tib tibant", "tib ant", "tibant", ""},
    {"tp tibpost", "tib post", "tibpost", ""},
    {"pl perl perlong fiblong", "per long", "perlong", ""},
    {"pb perb perbrev fibbrev", "per brev", "perbrev", ""},
    {"edl", "ext dig", "edl", "extdig"},
    {"ehl", "ext hal", "ehl", "exthal"},
    {"fdl", "flex dig", "fdl", "flexdig"},
    {"fhl", "flex hal", "fhl", "flexhal"},
    {"vl vaslat vaslateralis", "vas lat", "vaslat", "vasti"},
    {"vm vmo vasmed vasmedialis", "vas med", "vasmed", "vasti"},
    {"vi vasint", "vas int", "vasint", "vasti"},
    {"rf rec rect recfem rectfem", "rec fem", "recfem", "rectfem"},
    {"mh medham hammed", "med ham", "semimem semiten", "hamstrings"},
    {"lh latham hamlat", "lat ham", "bflh", "bifemlh hamstrings"},
    {"sm semimem semimemb", "semim", "semimem", ""},
    {"st semiten semitend", "semit", "semiten", ""},
    {"bfsh bfs bicfemsh bifemsh", "bic fem sh", "bfsh", "bifemsh"},
    {"bf bflh bicfem bifem bicepsfem bifemlh bicfemlh", "bic fem", "bflh", "bifemlh"},
    {"ham hams hamstring hamstrings", "ham", "semimem semiten bflh", "bifemlh hamstrings"},
    {"gmax glmax glumax glutmax gluteusmax gmx",
     "glu max",
     "glmax1 glmax2 glmax3",
     "glutmax1 glutmax2 glutmax3 glutmax"},
    {"gmed glmed glumed glutmed gluteusmed gmd",
     "glu med",
     "glmed1 glmed2 glmed3",
     "glutmed1 glutmed2 glutmed3"},
    {"gmin glmin glumin glutmin", "glu min", "glmin1 glmin2 glmin3", "glutmin1 glutmin2 glutmin3"},
    {"tfl tens", "tens fas", "tfl", ""},
    {"sart sar srt", "sart", "sart", "sar"},
    {"grac gra grc gr", "grac", "grac", ""},
    {"al addl addlong", "add long", "addlong", ""},
    {"am addmag",
     "add mag",
     "addmagdist addmagisch addmagmid addmagprox",
     "addmag1 addmag2 addmag3"},
    {"il iliacus", "iliac", "iliacus", ""},
    {"ps psoas iliopsoas", "psoas", "psoas", "iliopsoas"},
}};

// Words of channel names that name no muscle: what systems and laboratories put around it.
constexpr const char* kFillers =
    "emg semg im raw env envelope processed filtered rectified rms voltage volt analog analogue ch "
    "chan channel sensor trigno avanti delsys noraxon muscle musculus m v mv uv the of head";
constexpr const char* kRightWords = "r rt rgt right";
constexpr const char* kLeftWords = "l lt lft left";

Words splitWords(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool isUpper(char letter) {
  return std::isupper(static_cast<unsigned char>(letter)) != 0;
}
bool isLower(char letter) {
  return std::islower(static_cast<unsigned char>(letter)) != 0;
}
bool isAlnum(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0;
}

/// Lower-case words of a name: "R_TibAnt: EMG 3" -> "r", "tib", "ant", "emg", "3".
Words findWords(const std::string& label) {
  std::string spaced;
  for (std::size_t i = 0; i < label.size(); ++i) {
    const char letter = label[i];
    const bool begins_word =
        i > 0 && isUpper(letter) &&
        (isLower(label[i - 1]) || (i + 1 < label.size() && isLower(label[i + 1])));
    spaced += begins_word ? " " : "";
    spaced +=
        isAlnum(letter) ? static_cast<char>(std::tolower(static_cast<unsigned char>(letter))) : ' ';
  }
  return splitWords(spaced);
}

std::string join(const Words& words) {
  std::string joined;
  for (const std::string& word : words) {
    joined += word;
  }
  return joined;
}

/// A channel name without side and fillers.
struct ChannelName {
  Words words;
  std::optional<BodySide> side;
};

ChannelName parseName(const std::string& label) {
  static const Words fillers = splitWords(kFillers);
  static const Words right = splitWords(kRightWords);
  static const Words left = splitWords(kLeftWords);
  ChannelName name;
  for (const std::string& word : findWords(label)) {
    // "emg1" says no more than "emg"; "1" says nothing.
    const std::string letters = word.substr(0, word.find_last_not_of("0123456789") + 1);
    if (!name.side && (contains(right, word) || contains(left, word))) {
      name.side = contains(right, word) ? BodySide::kRight : BodySide::kLeft;
    } else if (!letters.empty() && !contains(fillers, letters)) {
      name.words.push_back(word);
    }
  }
  return name;
}

/// A muscle of the model as names compare: "glut_max1_r" -> "glutmax1", right.
struct ModelMuscle {
  std::string name;
  std::string key;
  std::optional<BodySide> side;
};

ModelMuscle parseMuscle(const std::string& name) {
  const std::string suffix = name.size() > 2 ? name.substr(name.size() - 2) : "";
  ModelMuscle muscle{name, "", {}};
  if (suffix == "_r" || suffix == "_l") {
    muscle.side = suffix == "_r" ? BodySide::kRight : BodySide::kLeft;
  }
  for (const char letter : muscle.side ? name.substr(0, name.size() - 2) : name) {
    if (isAlnum(letter)) {
      muscle.key += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
  }
  return muscle;
}

bool beginWords(const Words& stems, const Words& words) {
  return !stems.empty() && std::all_of(stems.begin(), stems.end(), [&](const std::string& stem) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return word.compare(0, stem.size(), stem) == 0;
    });
  });
}

/// A known muscle with its lists as words.
struct Entry {
  Words abbreviations;
  Words stems;
  Words keys;  ///< of its muscles in any model
};

const std::vector<Entry>& knownEntries() {
  static const std::vector<Entry> entries = [] {
    std::vector<Entry> built;
    for (const KnownMuscle& known : kKnownMuscles) {
      Entry entry{
          splitWords(known.abbreviations), splitWords(known.stems), splitWords(known.muscles)};
      const Words elsewhere = splitWords(known.elsewhere);
      entry.keys.insert(entry.keys.end(), elsewhere.begin(), elsewhere.end());
      built.push_back(std::move(entry));
    }
    return built;
  }();
  return entries;
}

/// Muscles that the words of an anatomical name stand for; empty if nobody knows.
Words findKeysByStems(const Words& words) {
  for (const Entry& entry : knownEntries()) {
    if (beginWords(entry.stems, words)) {
      return entry.keys;
    }
  }
  return {};
}

/// Muscles of one side of a model, found by name.
class MuscleIndex {
 public:
  explicit MuscleIndex(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      muscles_.push_back(parseMuscle(name));
    }
    if (names.empty()) {
      addOwnModel();
    }
  }

  /// Muscles of these keys, on this side.
  Words find(const Words& keys, BodySide side) const {
    Words found;
    for (const ModelMuscle& muscle : muscles_) {
      if (muscle.side.value_or(side) == side && contains(keys, muscle.key)) {
        found.push_back(muscle.name);
      }
    }
    return found;
  }

  bool has(const std::string& name) const {
    return std::any_of(muscles_.begin(), muscles_.end(), [&](const ModelMuscle& muscle) {
      return muscle.name == name;
    });
  }

 private:
  void addOwnModel() {
    for (const KnownMuscle& known : kKnownMuscles) {
      for (const std::string& muscle : splitWords(known.muscles)) {
        for (const char* side : {"_r", "_l"}) {
          if (!has(muscle + side)) {
            muscles_.push_back(parseMuscle(muscle + side));
          }
        }
      }
    }
  }

  std::vector<ModelMuscle> muscles_;
};

/// Muscles that a whole name without side stands for; empty if nobody knows.
Words findKeysByName(const std::string& key, const MuscleIndex& index) {
  if (!index.find({key}, BodySide::kRight).empty() || !index.find({key}, BodySide::kLeft).empty()) {
    return {key};
  }
  for (const Entry& entry : knownEntries()) {
    if (contains(entry.abbreviations, key)) {
      return entry.keys;
    }
  }
  return {};
}

/// A whole name and the side in it.
struct Reading {
  std::string key;
  std::optional<BodySide> side;
};

/// The name as it is, and without a first or last letter that may be its side: "rta", "glmax1r".
std::vector<Reading> listReadings(const ChannelName& name) {
  constexpr std::size_t kShortestWithSide = 3;
  const std::string key = join(name.words);
  std::vector<Reading> readings = {{key, name.side}};
  if (name.side || key.size() < kShortestWithSide) {
    return readings;
  }
  const auto sideOf = [](char letter) {
    return letter == 'r' ? BodySide::kRight : BodySide::kLeft;
  };
  if (key.front() == 'r' || key.front() == 'l') {
    readings.push_back({key.substr(1), sideOf(key.front())});
  }
  if (key.back() == 'r' || key.back() == 'l') {
    readings.push_back({key.substr(0, key.size() - 1), sideOf(key.back())});
  }
  return readings;
}

void readLabel(const std::string& label, const MuscleIndex& index, EmgChannel& channel) {
  const ChannelName name = parseName(label);
  for (const Reading& reading : listReadings(name)) {
    const Words keys = findKeysByName(reading.key, index);
    if (!keys.empty()) {
      channel.side = reading.side.value_or(channel.side);
      channel.muscles = index.find(keys, channel.side);
      return;
    }
  }
  channel.side = name.side.value_or(channel.side);
  channel.muscles = index.find(findKeysByStems(name.words), channel.side);
}

/// The muscles that the settings name. @returns those that the model does not have
Words assign(const Words& names, const MuscleIndex& index, EmgChannel& channel) {
  Words unknown;
  for (const std::string& name : names) {
    const std::string sided = name + (channel.side == BodySide::kRight ? "_r" : "_l");
    if (index.has(name) || index.has(sided)) {
      channel.muscles.push_back(index.has(name) ? name : sided);
    } else {
      unknown.push_back(name);
    }
  }
  if (!channel.muscles.empty()) {
    channel.side = parseMuscle(channel.muscles.front()).side.value_or(channel.side);
  }
  return unknown;
}

}  // namespace

const char* sideName(BodySide side) {
  return side == BodySide::kRight ? "right" : "left";
}

EmgChannels mapEmgChannels(const std::vector<std::string>& labels,
                           const std::vector<std::string>& muscles,
                           const EmgChannelOptions& options) {
  const MuscleIndex index(muscles);
  EmgChannels result;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EmgChannel channel{labels[i], static_cast<int>(i), {}, options.side};
    const auto assigned = options.channels.find(labels[i]);
    if (assigned == options.channels.end()) {
      readLabel(labels[i], index, channel);
    } else if (assigned->second.empty()) {
      continue;
    } else {
      channel.side = parseName(labels[i]).side.value_or(options.side);
      for (const std::string& unknown : assign(assigned->second, index, channel)) {
        result.warnings.push_back("the settings map channel '" + labels[i] + "' to '" + unknown +
                                  "', which is no muscle of the model");
      }
    }
    if (channel.muscles.empty() && assigned == options.channels.end()) {
      result.warnings.push_back("channel '" + labels[i] +
                                "' names no muscle that is known; map it in the settings' "
                                "emg.channels");
    }
    result.channels.push_back(channel);
  }
  for (const auto& [name, assigned] : options.channels) {
    if (!contains(labels, name)) {
      result.warnings.push_back("the settings map channel '" + name +
                                "', which the recording does not have");
    }
  }
  return result;
}

}  // namespace gaitmill
