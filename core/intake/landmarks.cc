#include "core/intake/landmarks.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Kind = LandmarkKind;
using Source = LocationSource;

constexpr double kBonyDeviation = 0.012;       // [m], see landmarks.h
constexpr double kJointDeviation = 0.015;      // [m]
constexpr double kTechnicalDeviation = 0.050;  // [m]

/// One line of the catalogue. Sided lines stand for the right side; their names lack the letter.
struct Row {
  const char* name;
  bool sided;
  const char* body;  // without "_r"
  double x, y, z;    // [m] in the body
  Kind kind;
  Source source;
  const char* description;
  double deviation = 0;  // [m]; 0 = that of the kind
};

constexpr bool kSided = true;
constexpr bool kMiddle = false;

// The clavicle marker of Rajagopal2016 stands 17 mm to the right and C7 2 mm; a landmark of the
// middle does not. RPSH and LPSH differ by 8 mm in the model; here both are the right one.
// One line a landmark.
// clang-format off
const Row kRows[] = {
    // Trunk.
    {"ACR", kSided, "torso", -0.003, 0.425, 0.13, Kind::kBony, Source::kModel, "acromion"},
    {"C7", kMiddle, "torso", -0.085, 0.435, 0, Kind::kBony, Source::kModel, "seventh cervical vertebra"},
    {"T2", kMiddle, "torso", -0.095, 0.405, 0, Kind::kBony, Source::kEstimate, "second thoracic vertebra", 0.015},
    {"T8", kMiddle, "torso", -0.11, 0.28, 0, Kind::kBony, Source::kMesh, "seventh or eighth thoracic vertebra", 0.02},
    {"T10", kMiddle, "torso", -0.10, 0.22, 0, Kind::kBony, Source::kModel, "tenth thoracic vertebra", 0.02},
    {"T12", kMiddle, "torso", -0.09, 0.15, 0, Kind::kBony, Source::kEstimate, "twelfth thoracic vertebra", 0.02},
    {"L1", kMiddle, "torso", -0.085, 0.12, 0, Kind::kBony, Source::kEstimate, "first lumbar vertebra", 0.02},
    {"CLAV", kMiddle, "torso", 0.04, 0.38, 0, Kind::kBony, Source::kModel, "jugular notch"},
    {"CLV", kSided, "torso", 0.046, 0.385, 0.025, Kind::kBony, Source::kSetup, "medial end of the clavicle"},
    {"CLVmid", kMiddle, "torso", 0.046, 0.385, 0, Kind::kDerived, Source::kSetup, "middle of the medial ends of the clavicles"},
    {"STRN", kMiddle, "torso", 0.09, 0.30, 0, Kind::kBony, Source::kSetup, "middle of the sternum", 0.02},
    {"XIPH", kMiddle, "torso", 0.10, 0.20, 0, Kind::kBony, Source::kMesh, "xiphoid process", 0.02},
    {"NAVE", kMiddle, "torso", 0.115, 0.05, 0, Kind::kTechnical, Source::kEstimate, "navel"},
    {"ASH", kSided, "torso", 0.05, 0.3715, 0.17, Kind::kBony, Source::kModel, "front of the shoulder", 0.02},
    {"PSH", kSided, "torso", -0.05, 0.3715, 0.17, Kind::kBony, Source::kModel, "back of the shoulder", 0.02},
    {"SCA", kSided, "torso", -0.11, 0.33, 0.08, Kind::kTechnical, Source::kEstimate, "scapula"},
    {"SJCmid", kMiddle, "torso", 0.003155, 0.3715, 0, Kind::kDerived, Source::kModel, "middle of the shoulder centres, base of the neck", 0.03},
    // Head; it belongs to the torso in these models.
    {"TOPH", kMiddle, "torso", 0, 0.67, 0, Kind::kTechnical, Source::kSetup, "top of the head"},
    {"TEM", kSided, "torso", 0.06, 0.60, 0.07, Kind::kTechnical, Source::kSetup, "temple"},
    {"FHD", kSided, "torso", 0.07, 0.62, 0.06, Kind::kTechnical, Source::kEstimate, "front of the head"},
    {"BHD", kSided, "torso", -0.08, 0.60, 0.055, Kind::kTechnical, Source::kEstimate, "back of the head"},
    {"FHDmid", kMiddle, "torso", 0.095, 0.61, 0, Kind::kTechnical, Source::kEstimate, "forehead"},
    {"BHDmid", kMiddle, "torso", -0.09, 0.59, 0, Kind::kTechnical, Source::kEstimate, "back of the head, middle"},
    {"EAR", kSided, "torso", 0, 0.56, 0.08, Kind::kTechnical, Source::kMesh, "ear"},
    {"EYE", kSided, "torso", 0.09, 0.57, 0.03, Kind::kTechnical, Source::kMesh, "eye"},
    {"NOSE", kMiddle, "torso", 0.115, 0.55, 0, Kind::kTechnical, Source::kMesh, "nose"},
    {"CHIN", kMiddle, "torso", 0.095, 0.485, 0, Kind::kTechnical, Source::kMesh, "chin"},
    // Arms.
    {"SJC", kSided, "humerus", 0, 0, 0, Kind::kJointCenter, Source::kModel, "centre of the shoulder"},
    {"UA1", kSided, "humerus", 0, -0.05, 0.02, Kind::kTechnical, Source::kModel, "upper arm, first of a cluster"},
    {"UA2", kSided, "humerus", 0, -0.20, 0.02, Kind::kTechnical, Source::kModel, "upper arm, second of a cluster"},
    {"UA3", kSided, "humerus", 0.03, -0.13, 0.02, Kind::kTechnical, Source::kModel, "upper arm, third of a cluster"},
    {"UPA", kSided, "humerus", 0, -0.14, 0.05, Kind::kTechnical, Source::kEstimate, "upper arm, lateral"},
    {"BIC", kSided, "humerus", 0.04, -0.15, 0, Kind::kTechnical, Source::kSetup, "biceps"},
    {"LEL", kSided, "humerus", 0.015, -0.28, 0.04, Kind::kBony, Source::kModel, "lateral epicondyle of the elbow"},
    {"MEL", kSided, "humerus", 0.00225, -0.286, -0.046, Kind::kBony, Source::kModel, "medial epicondyle of the elbow"},
    {"ELmid", kSided, "humerus", 0.008625, -0.283, -0.003, Kind::kDerived, Source::kModel, "middle of the epicondyles of the elbow"},
    {"EJC", kSided, "ulna", 0, 0, 0, Kind::kJointCenter, Source::kModel, "centre of the elbow"},
    {"OLE", kSided, "ulna", -0.043, -0.02, 0, Kind::kBony, Source::kMesh, "olecranon"},
    {"FAsuperior", kSided, "ulna", 0.0046045, -0.0800579, 0.0453196, Kind::kTechnical, Source::kModel, "forearm, upper"},
    {"FRM", kSided, "ulna", 0, -0.15, 0, Kind::kTechnical, Source::kSetup, "forearm"},
    {"FAradius", kSided, "radius", 0.0005, -0.225, 0.05, Kind::kBony, Source::kModel, "styloid process of the radius"},
    {"FAulna", kSided, "radius", -0.022, -0.225, -0.022, Kind::kBony, Source::kModel, "styloid process of the ulna"},
    {"WRI", kSided, "radius", -0.03, -0.24, 0.006, Kind::kBony, Source::kSetup, "back of the wrist", 0.02},
    {"WRmid", kSided, "radius", -0.01075, -0.225, 0.014, Kind::kDerived, Source::kModel, "middle of the styloid processes"},
    {"WJC", kSided, "radius", -0.01, -0.23187, 0.017, Kind::kJointCenter, Source::kModel, "centre of the wrist"},
    {"FIN", kSided, "hand", -0.02, -0.085, 0.005, Kind::kBony, Source::kMesh, "head of the second or third metacarpal", 0.02},
    {"MC2", kSided, "hand", -0.012, -0.085, 0.025, Kind::kBony, Source::kMesh, "head of the second metacarpal", 0.02},
    {"MC5", kSided, "hand", -0.012, -0.07, -0.035, Kind::kBony, Source::kMesh, "head of the fifth metacarpal", 0.02},
    // Pelvis.
    {"ASI", kSided, "pelvis", 0.00953047, 0.0180816, 0.128464, Kind::kBony, Source::kModel, "anterior superior iliac spine"},
    {"PSI", kSided, "pelvis", -0.155, 0.035, 0.045, Kind::kBony, Source::kModel, "posterior superior iliac spine"},
    {"SACR", kMiddle, "pelvis", -0.16, 0.035, 0, Kind::kBony, Source::kSetup, "sacrum, between the posterior superior iliac spines"},
    {"S2", kMiddle, "pelvis", -0.18, 0.025, 0, Kind::kBony, Source::kSetup, "second sacral vertebra", 0.015},
    {"L5", kMiddle, "pelvis", -0.165, 0.07, 0, Kind::kBony, Source::kEstimate, "fifth lumbar vertebra", 0.02},
    {"ASImid", kMiddle, "pelvis", 0.00953047, 0.0180816, 0, Kind::kDerived, Source::kModel, "middle of the anterior superior iliac spines"},
    {"PSImid", kMiddle, "pelvis", -0.155, 0.035, 0, Kind::kDerived, Source::kModel, "middle of the posterior superior iliac spines"},
    {"HJCmid", kMiddle, "pelvis", -0.056276, -0.07849, 0, Kind::kDerived, Source::kModel, "middle of the hip centres", 0.03},
    {"ILC", kSided, "pelvis", -0.05, 0.085, 0.135, Kind::kBony, Source::kMesh, "iliac crest", 0.025},
    // Thighs.
    {"HJC", kSided, "femur", 0, 0, 0, Kind::kJointCenter, Source::kModel, "centre of the hip"},
    {"GTR", kSided, "femur", -0.015, -0.02, 0.085, Kind::kBony, Source::kMesh, "greater trochanter", 0.02},
    {"TH1", kSided, "femur", 0.018, -0.15, 0.064, Kind::kTechnical, Source::kModel, "thigh, first of a cluster"},
    {"TH2", kSided, "femur", 0.08, -0.23, 0.0047, Kind::kTechnical, Source::kModel, "thigh, second of a cluster"},
    {"TH3", kSided, "femur", 0.01, -0.30, 0.06, Kind::kTechnical, Source::kModel, "thigh, third of a cluster"},
    {"TH4", kSided, "femur", 0.012, -0.22, 0.08, Kind::kTechnical, Source::kEstimate, "thigh, fourth of a cluster"},
    {"THI", kSided, "femur", 0, -0.25, 0.085, Kind::kTechnical, Source::kEstimate, "thigh, lateral, often on a wand"},
    {"THAP", kSided, "femur", 0.075, -0.15, 0.01, Kind::kTechnical, Source::kEstimate, "thigh, front, upper"},
    {"THAD", kSided, "femur", 0.06, -0.32, 0, Kind::kTechnical, Source::kEstimate, "thigh, front, lower"},
    {"LFC", kSided, "femur", 0, -0.404, 0.05, Kind::kBony, Source::kModel, "lateral condyle of the knee"},
    {"MFC", kSided, "femur", 0, -0.404, -0.05, Kind::kBony, Source::kModel, "medial condyle of the knee"},
    {"FCmid", kSided, "femur", 0, -0.404, 0, Kind::kDerived, Source::kModel, "middle of the condyles of the knee"},
    {"KAX", kSided, "femur", 0, -0.404, 0.12, Kind::kTechnical, Source::kEstimate, "knee alignment device, on the axis"},
    {"KD1", kSided, "femur", 0, -0.36, 0.08, Kind::kTechnical, Source::kEstimate, "knee alignment device, first"},
    {"KD2", kSided, "femur", 0.04, -0.43, 0.08, Kind::kTechnical, Source::kEstimate, "knee alignment device, second"},
    {"PAT", kSided, "patella", 0.025, 0.03, 0, Kind::kTechnical, Source::kMesh, "patella"},
    // Shanks.
    {"KJC", kSided, "tibia", 0.001731, -0.002389, -0.008452, Kind::kJointCenter, Source::kModel, "centre of the knee"},
    {"FIB", kSided, "tibia", -0.01, -0.065, 0.055, Kind::kBony, Source::kMesh, "head of the fibula"},
    {"TTU", kSided, "tibia", 0.048, -0.07, -0.005, Kind::kBony, Source::kMesh, "tuberosity of the tibia"},
    {"TB1", kSided, "tibia", -0.00166178, -0.156488, 0.0492394, Kind::kTechnical, Source::kModel, "shank, first of a cluster"},
    {"TB2", kSided, "tibia", 0.0369643, -0.230107, -0.00391699, Kind::kTechnical, Source::kModel, "shank, second of a cluster"},
    {"TB3", kSided, "tibia", 0.0113793, -0.295236, 0.0553541, Kind::kTechnical, Source::kModel, "shank, third of a cluster"},
    {"TB4", kSided, "tibia", 0.012, -0.22, 0.06, Kind::kTechnical, Source::kEstimate, "shank, fourth of a cluster"},
    {"TIB", kSided, "tibia", 0, -0.22, 0.06, Kind::kTechnical, Source::kEstimate, "shank, lateral, often on a wand"},
    {"TIAP", kSided, "tibia", 0.045, -0.13, 0, Kind::kTechnical, Source::kEstimate, "shank, front, upper"},
    {"TIAD", kSided, "tibia", 0.03, -0.29, -0.005, Kind::kTechnical, Source::kEstimate, "shank, front, lower"},
    {"LMAL", kSided, "tibia", -0.005, -0.3888, 0.053, Kind::kBony, Source::kModel, "lateral malleolus"},
    {"MMAL", kSided, "tibia", 0.006, -0.3888, -0.038, Kind::kBony, Source::kModel, "medial malleolus"},
    {"MALmid", kSided, "tibia", 0.0005, -0.3888, 0.0075, Kind::kDerived, Source::kModel, "middle of the malleoli"},
    {"MALfloor", kSided, "tibia", 0.0005, -0.44695, 0.0075, Kind::kDerived, Source::kSetup, "middle of the malleoli, projected on the floor"},
    // Feet.
    {"AJC", kSided, "talus", 0, 0, 0, Kind::kJointCenter, Source::kModel, "centre of the ankle"},
    {"CAL", kSided, "calcn", -0.025, 0.02, -0.005, Kind::kBony, Source::kModel, "heel"},
    {"LCA", kSided, "calcn", 0, 0.02, 0.03, Kind::kTechnical, Source::kEstimate, "heel, lateral side", 0.02},
    {"MCA", kSided, "calcn", 0, 0.02, -0.035, Kind::kTechnical, Source::kEstimate, "heel, medial side", 0.02},
    {"DFT", kSided, "calcn", 0.10, 0.055, 0, Kind::kTechnical, Source::kSetup, "back of the foot", 0.03},
    {"NAV", kSided, "calcn", 0.065, 0.03, -0.04, Kind::kBony, Source::kEstimate, "navicular", 0.02},
    {"B5M", kSided, "calcn", 0.07, 0.02, 0.045, Kind::kBony, Source::kSetup, "outer edge of the midfoot, base of the fifth metatarsal", 0.02},
    {"TOE", kSided, "calcn", 0.205, 0.0297308, -0.03, Kind::kBony, Source::kModel, "joint of the great toe, from above"},
    {"MT1", kSided, "calcn", 0.19, 0.02, -0.045, Kind::kBony, Source::kSetup, "head of the first metatarsal"},
    {"MT2", kSided, "calcn", 0.183, 0.035, -0.005, Kind::kBony, Source::kMesh, "head of the second metatarsal"},
    {"MT5", kSided, "calcn", 0.145, 0.02491, 0.059, Kind::kBony, Source::kModel, "head of the fifth metatarsal"},
    {"TIP", kSided, "calcn", 0.235, 0.02, -0.005, Kind::kBony, Source::kSetup, "tip of the toes", 0.02},
    {"HLX", kSided, "toes", 0.06, 0.018, -0.02, Kind::kBony, Source::kMesh, "great toe", 0.02},
    {"TO5", kSided, "toes", 0.01, 0.01, 0.055, Kind::kTechnical, Source::kEstimate, "small toe", 0.03},
    {"CALfloor", kSided, "calcn", -0.02, -0.005, -0.01, Kind::kDerived, Source::kSetup, "heel, projected on the floor"},
    {"TIPfloor", kSided, "calcn", 0.23, -0.005, -0.016, Kind::kDerived, Source::kSetup, "tip of the toes, projected on the floor"},
    {"MT5floor", kSided, "calcn", 0.16, -0.005, 0.05, Kind::kDerived, Source::kSetup, "head of the fifth metatarsal, projected on the floor"},
};
// clang-format on

/// Body origins of Rajagopal2016 from the pelvis origin, every coordinate 0, right side [m].
struct BodyOrigin {
  const char* body;
  double x, y, z;
};

const BodyOrigin kOrigins[] = {
    {"pelvis", 0, 0, 0},
    {"torso", -0.1007, 0.0815, 0},
    {"humerus_r", -0.097545, 0.453, 0.17},
    {"ulna_r", -0.084401, 0.166727, 0.160405},
    {"radius_r", -0.091128, 0.15372, 0.186488},
    {"hand_r", -0.099925, -0.082121, 0.200098},
    {"femur_r", -0.056276, -0.07849, 0.07726},
    {"patella_r", -0.011966, -0.49725, 0.07726},
    {"tibia_r", -0.056276, -0.482915, 0.075995},
    {"talus_r", -0.066276, -0.882915, 0.075995},
    {"calcn_r", -0.115046, -0.924865, 0.083915},
    {"toes_r", 0.063754, -0.926865, 0.084995},
};

double findDeviation(const Row& row) {
  if (row.deviation > 0) {
    return row.deviation;
  }
  switch (row.kind) {
    case Kind::kTechnical:
      return kTechnicalDeviation;
    case Kind::kBony:
      return kBonyDeviation;
    case Kind::kJointCenter:
    case Kind::kDerived:
      break;
  }
  return kJointDeviation;
}

bool isPaired(const std::string& body) {
  return body != "pelvis" && body != "torso";
}

Landmark makeLandmark(const Row& row, Side side) {
  Landmark mark;
  mark.side = side;
  mark.kind = row.kind;
  mark.source = row.source;
  mark.placement_deviation = findDeviation(row);
  const bool left = side == Side::kLeft;
  mark.location = {row.x, row.y, left ? -row.z : row.z};
  mark.body = row.body;
  mark.name = row.name;
  mark.description = row.description;
  if (side != Side::kMiddle) {
    mark.name.insert(0, left ? "L" : "R");
    mark.description += left ? ", left" : ", right";
  }
  if (isPaired(mark.body)) {
    mark.body += left ? "_l" : "_r";
  }
  return mark;
}

std::vector<Landmark> makeLandmarks() {
  std::vector<Landmark> all;
  for (const Row& row : kRows) {
    if (!row.sided) {
      all.push_back(makeLandmark(row, Side::kMiddle));
      continue;
    }
    all.push_back(makeLandmark(row, Side::kRight));
    all.push_back(makeLandmark(row, Side::kLeft));
  }
  return all;
}

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

/// Other names that models give to these bodies, in lower case, side included.
std::vector<std::string> listAliases(const std::string& body) {
  if (body == "torso") {
    return {"thorax", "trunk", "hat"};
  }
  if (body.size() < 2 || body[body.size() - 2] != '_') {
    return {};
  }
  const std::string stem = body.substr(0, body.size() - 2);
  std::vector<std::string> aliases = {stem + "." + body.back(),
                                      std::string(1, body.back()) + "_" + stem};
  // Models of one leg name its bodies without a side; that leg is the right one.
  if (body.back() == 'r') {
    aliases.push_back(stem);
  }
  return aliases;
}

}  // namespace

const std::vector<Landmark>& landmarks() {
  static const std::vector<Landmark> all = makeLandmarks();
  return all;
}

const Landmark* findLandmark(const std::string& name) {
  static const std::map<std::string, const Landmark*> by_name = [] {
    std::map<std::string, const Landmark*> index;
    for (const Landmark& mark : landmarks()) {
      index.emplace(mark.name, &mark);
    }
    return index;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

void requireLandmark(const std::string& name, const Where& where) {
  if (findLandmark(name) != nullptr) {
    return;
  }
  std::vector<std::string> names;
  for (const Landmark& mark : landmarks()) {
    names.push_back(mark.name);
  }
  const std::string nearest = findNearestName(name, names);
  throw Error(ErrorCode::kMarkerNames,
              "there is no landmark '" + name + "'" +
                  (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
              where);
}

const Landmark* findOpposite(const std::string& name) {
  const Landmark* mark = findLandmark(name);
  if (mark == nullptr || mark->side == Side::kMiddle) {
    return mark;
  }
  std::string other = name;
  other[0] = mark->side == Side::kRight ? 'L' : 'R';
  return findLandmark(other);
}

std::optional<std::string> findModelBody(const std::string& body, const ModelSpec& model) {
  if (model.findBody(body) >= 0) {
    return body;
  }
  std::vector<std::string> names = listAliases(body);
  names.insert(names.begin(), toLower(body));
  for (const std::string& name : names) {
    for (const BodySpec& candidate : model.bodies) {
      if (toLower(candidate.name) == name) {
        return candidate.name;
      }
    }
  }
  return std::nullopt;
}

Eigen::Vector3d calcStandingPosition(const Landmark& landmark) {
  std::string body = landmark.body;
  double mirror = 1;
  if (isPaired(body) && body.back() == 'l') {
    body.back() = 'r';
    mirror = -1;
  }
  for (const BodyOrigin& origin : kOrigins) {
    if (body == origin.body) {
      return landmark.location + Eigen::Vector3d(origin.x, origin.y, mirror * origin.z);
    }
  }
  return landmark.location;
}

}  // namespace gaitmill
