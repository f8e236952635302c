#include "core/intake/marker_words.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <optional>
#include <set>

#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

/// Spellings of one landmark: words in any order, joined and sorted before they are compared.
struct Spelling {
  const char* landmark;  // "@" = the side
  std::vector<const char*> words;
};

// "knee lat" also stands for "lat knee"; words of one name are separated by blanks.
// clang-format off
const std::vector<Spelling>& spellings() {
  static const std::vector<Spelling> all = {
      {"@ASI", {"asis", "asi", "sias", "ias", "ant iliac", "ant iliac spine", "ant sup iliac spine", "asi s"}},
      {"@PSI", {"psis", "psi", "sips", "ips", "post iliac", "post iliac spine", "post sup iliac spine"}},
      {"SACR", {"sacr", "sacrum", "sacral", "v sacral", "sacr v", "s1", "sac"}},
      {"S2", {"s2"}},
      {"L5", {"l5"}},
      {"@ILC", {"iliac crest", "crest", "ilc", "il", "ilium"}},
      {"@GTR", {"troch", "trochanter", "gr trochanter", "trochanter gr", "gtroch", "gtr", "gt"}},
      {"@HJC", {"hjc", "hip center", "hip joint center", "hip jc", "hip"}},
      {"@KJC", {"kjc", "knee center", "knee joint center", "knee jc"}},
      {"@AJC", {"ajc", "ankle center", "ankle joint center", "ankle jc"}},
      {"@TH1", {"th 1", "thigh 1", "thi 1", "thigh upper", "upper leg 1"}},
      {"@TH2", {"th 2", "thigh 2", "thi 2", "thigh front", "upper leg 2"}},
      {"@TH3", {"th 3", "thigh 3", "thi 3", "thigh rear", "upper leg 3"}},
      {"@TH4", {"th 4", "thigh 4", "thi 4", "upper leg 4"}},
      {"@THI", {"thigh", "thi", "thigh lat"}},
      {"@LFC", {"knee", "knee lat", "kne", "kne lat", "lknee", "lat epi", "femur epi lat", "epi femur lat", "lfc", "lfe", "fle",
                "lat condyle", "condyle femur lat", "lek", "lat femur", "knee outer", "knee out"}},
      {"@MFC", {"knee med", "kne med", "mknee", "mkne", "epi med", "femur epi med", "mfc", "mfe", "fme", "condyle med",
                "condyle femur med", "mek", "femur med", "knee inner", "knee in"}},
      {"@PAT", {"pat", "patella"}},
      {"@FIB", {"fib", "fibula", "fibula head", "fib head", "hf"}},
      {"@TTU", {"tibial tuberosity", "tuberosity", "ttc", "tt", "tibia tuberosity", "tib tub"}},
      {"@TB1", {"tb 1", "shank 1", "sh 1", "tib 1", "shank upper", "sk 1", "lower leg 1"}},
      {"@TB2", {"tb 2", "shank 2", "sh 2", "tib 2", "shank front", "sk 2", "lower leg 2"}},
      {"@TB3", {"tb 3", "shank 3", "sh 3", "tib 3", "shank rear", "sk 3", "lower leg 3"}},
      {"@TB4", {"tb 4", "shank 4", "sh 4", "tib 4", "sk 4", "lower leg 4"}},
      {"@TIB", {"shank", "tib", "tibia", "shin", "shank lat"}},
      {"@LMAL", {"ankle", "ankle lat", "ank", "ank lat", "mal lat", "malleolus lat", "lmal", "fal", "lank", "ankle outer",
                 "ankle out"}},
      {"@MMAL", {"ankle med", "ank med", "mal med", "malleolus med", "mmal", "tam", "mank", "mankle", "ankle inner",
                 "ankle in"}},
      {"@CAL", {"heel", "hee", "cal", "calc", "calcaneus", "calcn", "fcc", "heel post", "calc post"}},
      {"@LCA", {"heel lat", "calc lat", "lca", "calcaneus lat"}},
      {"@MCA", {"heel med", "calc med", "mca", "calcaneus med"}},
      {"@MT1", {"mt 1", "met 1", "mth 1", "meta 1", "metatarsal 1", "toe med", "fm 1", "first met", "first metatarsal",
                "metatarsal head 1", "m 1", "p mt 1"}},
      {"@MT2", {"mt 2", "met 2", "mth 2", "meta 2", "metatarsal 2", "fm 2", "second met", "second metatarsal", "metatarsal head 2",
                "toe 2"}},
      {"@MT5", {"mt 5", "met 5", "mth 5", "meta 5", "metatarsal 5", "toe lat", "fm 5", "fifth met", "fifth metatarsal",
                "metatarsal head 5", "m 5", "mt p 5"}},
      {"@TOE", {"toe"}},
      {"@TIP", {"toe tip", "tip"}},
      {"@HLX", {"hallux", "big toe", "hal", "great toe", "hlx", "hx"}},
      {"@TO5", {"small toe", "little toe"}},
      {"@DFT", {"midfoot", "midfoot sup", "dorsum foot", "dft"}},
      {"@B5M", {"midfoot lat"}},
      {"@NAV", {"nav", "navicular"}},
      {"C7", {"c 7", "cv 7"}},
      {"T10", {"t 10", "tv 10"}},
      {"T8", {"t 8", "tv 8", "t 7", "tv 7"}},
      {"T12", {"t 12", "tv 12"}},
      {"T2", {"t 2", "tv 2"}},
      {"CLAV", {"clav", "clavicle", "jug notch", "jugular notch", "suprasternal", "suprasternal notch", "ij", "sjn", "manubrium"}},
      {"@CLV", {"clav", "clavicle"}},
      {"STRN", {"strn", "sternum", "stern", "chest"}},
      {"XIPH", {"xiph", "xiphoid", "xyph", "px", "xiphoid process"}},
      {"@ACR", {"acr", "acromion", "acromium", "acrom", "shoulder", "sho", "shld", "shoulder lat", "ac", "caj", "shoulder top"}},
      {"@ASH", {"shoulder ant", "shoulder front", "ash"}},
      {"@PSH", {"shoulder post", "shoulder back", "psh"}},
      {"@SJC", {"sjc", "shoulder center", "shoulder joint center", "shoulder jc"}},
      {"@SCA", {"scap", "scapula", "offset", "bak", "back"}},
      {"@BIC", {"bicep", "biceps"}},
      {"@UPA", {"upa", "upper arm", "arm", "arm upper lat"}},
      {"@UA1", {"ua 1", "upper arm 1"}},
      {"@UA2", {"ua 2", "upper arm 2"}},
      {"@UA3", {"ua 3", "upper arm 3"}},
      {"@LEL", {"elbow", "elb", "elbow lat", "elb lat", "lelbow", "lel", "hle", "epi hum lat", "elbow outer", "elbow out"}},
      {"@MEL", {"elbow med", "elb med", "melbow", "mel", "hme", "epi hum med", "elbow inner", "elbow in"}},
      {"@EJC", {"ejc", "elbow center", "elbow joint center", "elbow jc"}},
      {"@OLE", {"olecranon", "ole"}},
      {"@FRM", {"frm", "forearm", "fore arm", "fa"}},
      {"@FAradius", {"radius", "wra", "wrist rad", "wrist radius", "wrist lat", "rsp", "styloid radius", "lwrist", "rad", "wrist thumb"}},
      {"@FAulna", {"ulna", "wrb", "wrist uln", "wrist ulna", "wrist med", "usp", "styloid ulna", "mwrist", "uln", "wrist pinky"}},
      {"@WRI", {"wrist", "wri", "wr"}},
      {"@WJC", {"wjc", "wrist center", "wrist joint center", "wrist jc"}},
      {"@FIN", {"fin", "finger", "hand", "mc 3", "knuckle", "hn knuckle"}},
      {"@MC2", {"mc 2", "hm 2"}},
      {"@MC5", {"mc 5", "hm 5"}},
      {"@FHD", {"head front", "fhd"}},
      {"@BHD", {"head back", "head rear", "bhd"}},
      {"@TEM", {"temple", "tem", "head"}},
      {"@EAR", {"ear"}},
      {"@EYE", {"eye"}},
      {"NOSE", {"nose"}},
      {"CHIN", {"chin"}},
      {"TOPH", {"head top", "top head", "vertex", "head"}},
      {"FHDmid", {"head front", "forehead"}},
      {"BHDmid", {"head back", "head rear"}},
      {"SJCmid", {"neck"}},
      {"HJCmid", {"mid hip", "pelvis center"}}};
  return all;
}

/// One spelling of words that are written in several ways.
const std::map<std::string, std::string>& synonyms() {
  static const std::map<std::string, std::string> table = {
      {"lateral", "lat"}, {"medial", "med"}, {"anterior", "ant"}, {"posterior", "post"}, {"superior", "sup"},
      {"inferior", "inf"}, {"epicondyle", "epi"}, {"epicond", "epi"}, {"femoral", "femur"}, {"fem", "femur"},
      {"humeral", "hum"}, {"humerus", "hum"}, {"centre", "center"}, {"jointcenter", "jc"}, {"jointcentre", "jc"},
      {"greater", "gr"}, {"1st", "1"}, {"2nd", "2"}, {"5th", "5"}, {"mal", "mal"}, {"malleoli", "malleolus"},
      {"tibial", "tibia"}, {"calcaneal", "calc"}, {"metatarsus", "metatarsal"}, {"metatarsals", "metatarsal"},
      {"inside", "in"}, {"outside", "out"}, {"radial", "radius"}, {"ulnar", "ulna"}, {"bigtoe", "big toe"}};
  return table;
}
// clang-format on

const std::set<std::string>& emptyWords() {
  static const std::set<std::string> words = {
      "marker", "mkr", "study", "static", "dyn", "virtual", "vm", "the", "of", "joint", "m"};
  return words;
}

bool isLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool isUpper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Whether a word ends between two characters: "kneeLat", "MT5", "1st" (which stays whole).
bool breaksBetween(char a, char b) {
  if (isDigit(a) && isLetter(b)) {
    return isUpper(b);
  }
  if (isLetter(a) && isDigit(b)) {
    return true;
  }
  return isLetter(a) && !isUpper(a) && isUpper(b);
}

std::vector<std::string> splitWords(const std::string& name) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) {
      words.push_back(word);
    }
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!isLetter(name[i]) && !isDigit(name[i])) {
      finish();
      continue;
    }
    if (i > 0 && breaksBetween(name[i - 1], name[i])) {
      finish();
    }
    word += lower(name[i]);
  }
  finish();
  return words;
}

std::string joinSorted(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  std::string joined;
  for (const std::string& word : words) {
    joined += (joined.empty() ? "" : " ") + word;
  }
  return joined;
}

std::string joinSorted(const char* words) {
  return joinSorted(splitWords(words));
}

/// Landmarks with "@" by their words, sorted; the words run together count as one as well.
const std::multimap<std::string, std::string>& spellingIndex() {
  static const std::multimap<std::string, std::string> index = [] {
    std::multimap<std::string, std::string> entries;
    for (const Spelling& spelling : spellings()) {
      for (const char* words : spelling.words) {
        entries.emplace(joinSorted(words), spelling.landmark);
        std::string together = words;
        together.erase(std::remove(together.begin(), together.end(), ' '), together.end());
        if (together != words) {
          entries.emplace(joinSorted(std::vector<std::string>{together}), spelling.landmark);
        }
      }
    }
    return entries;
  }();
  return index;
}

std::optional<Side> readSideWord(const std::string& word) {
  static const std::map<std::string, Side> table = {{"r", Side::kRight},
                                                    {"right", Side::kRight},
                                                    {"rt", Side::kRight},
                                                    {"rgt", Side::kRight},
                                                    {"l", Side::kLeft},
                                                    {"left", Side::kLeft},
                                                    {"lt", Side::kLeft},
                                                    {"lft", Side::kLeft}};
  const auto found = table.find(word);
  return found == table.end() ? std::nullopt : std::optional<Side>(found->second);
}

/// Words without those that say nothing, written in one way.
std::vector<std::string> normalizeWords(const std::vector<std::string>& words) {
  std::vector<std::string> normal;
  for (const std::string& word : words) {
    if (emptyWords().count(word) > 0) {
      continue;
    }
    const auto synonym = synonyms().find(word);
    normal.push_back(synonym == synonyms().end() ? word : synonym->second);
  }
  return normal;
}

/// Landmarks of these words on one side; a middle landmark needs Side::kMiddle.
std::vector<std::string> findSpelled(const std::vector<std::string>& words, Side side) {
  std::set<std::string> found;
  const auto [first, last] = spellingIndex().equal_range(joinSorted(normalizeWords(words)));
  for (auto entry = first; entry != last; ++entry) {
    std::string landmark = entry->second;
    if ((landmark[0] == '@') != (side != Side::kMiddle)) {
      continue;
    }
    if (side != Side::kMiddle) {
      landmark[0] = side == Side::kRight ? 'R' : 'L';
    }
    found.insert(landmark);
  }
  return {found.begin(), found.end()};
}

/// The words without the side word, if there is exactly one.
std::optional<Side> takeSide(std::vector<std::string>& words) {
  std::optional<Side> side;
  std::vector<std::string> others;
  for (const std::string& word : words) {
    const std::optional<Side> read = readSideWord(word);
    if (read && side) {
      return std::nullopt;
    }
    side = read ? read : side;
    if (!read) {
      others.push_back(word);
    }
  }
  if (side) {
    words = others;
  }
  return side;
}

/// "rknee", "rightknee", "kneer": a side glued to the first or last word.
std::vector<std::string> findGlued(const std::vector<std::string>& words) {
  for (const char* prefix : {"right", "left", "rt", "lt", "r", "l"}) {
    const std::string letters = prefix;
    const Side side = *readSideWord(letters);
    std::vector<std::string> cut = words;
    if (cut.front().size() > letters.size() &&
        cut.front().compare(0, letters.size(), letters) == 0) {
      cut.front().erase(0, letters.size());
      const std::vector<std::string> found = findSpelled(cut, side);
      if (!found.empty()) {
        return found;
      }
    }
    cut = words;
    std::string& end = cut.back();
    if (end.size() > letters.size() &&
        end.compare(end.size() - letters.size(), letters.size(), letters) == 0) {
      end.erase(end.size() - letters.size());
      const std::vector<std::string> found = findSpelled(cut, side);
      if (!found.empty()) {
        return found;
      }
    }
  }
  return {};
}

}  // namespace

std::string simplifyMarkerName(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  std::string text = colon == std::string::npos ? name : name.substr(colon + 1);
  std::transform(text.begin(), text.end(), text.begin(), lower);
  const std::size_t first = text.find_first_not_of(" \t");
  const std::size_t last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> readMarkerWords(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  std::vector<std::string> words =
      splitWords(colon == std::string::npos ? name : name.substr(colon + 1));
  if (words.empty()) {
    return {};
  }
  const std::vector<std::string> middle = findSpelled(words, Side::kMiddle);
  std::vector<std::string> rest = words;
  const std::optional<Side> side = takeSide(rest);
  if (side && !rest.empty()) {
    return findSpelled(rest, *side);
  }
  return middle.empty() ? findGlued(words) : middle;
}

}  // namespace gaitmill
