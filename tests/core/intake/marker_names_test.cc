#include "core/intake/marker_names.h"

#include <algorithm>
#include <random>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/intake/landmarks.h"
#include "core/intake/marker_name_sets.h"
#include "core/io/files.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

int countMapped(const MarkerMapping& mapping) {
  return static_cast<int>(mapping.names.size() - mapping.listUnmapped().size());
}

std::string landmarkOf(const MarkerMapping& mapping, const std::string& measured) {
  const MarkerName* name = mapping.find(measured);
  return name == nullptr ? "?" : name->landmark;
}

MarkerTrajectories readMarkers(const std::string& path) {
  return readTrc(readFile(path), path, {}).markers;
}

class SharedMarkerNames : public SharedDataTest {};

// Every trial of the shared data maps whole, by the set of its own laboratory, without help.
TEST_F(SharedMarkerNames, MapWithoutHelp) {
  const struct {
    const char* file;
    const char* set;
    int markers;
  } trials[] = {
      {"walk/motion_capture_walk.trc", "stanford_walk", 41},
      {"walk/static_walk_1.trc", "stanford_walk", 64},
      {"walk/static_walk_2.trc", "stanford_walk", 41},
      {"run/paper_subject01/static_run.trc", "rajagopal2016", 64},
      {"run/paper_subject01/motion_capture_run.trc", "rajagopal2016", 42},
      {"run/hamner2010/subject02_static.trc", "hamner2010", 49},
      {"run/hamner2010/subject02_running.trc", "hamner2010", 41},
      {"run/hamner2013_subject04/run400/markers.trc", "rajagopal2016", 42},
  };
  for (const auto& trial : trials) {
    SCOPED_TRACE(trial.file);
    const MarkerMapping mapping =
        mapMarkerNames(readMarkers(shared(std::string("data/") + trial.file)).names);
    EXPECT_EQ(mapping.set, trial.set);
    EXPECT_EQ(mapping.set_share, 1.0);
    EXPECT_EQ(countMapped(mapping), trial.markers);
    for (const MarkerName& name : mapping.names) {
      EXPECT_EQ(name.confidence, 0.98) << name.measured << ": " << name.reason;
    }
  }
}

// Scaling and inverse kinematics have what they need; running trials have clusters instead of the
// markers of knee and ankle.
TEST_F(SharedMarkerNames, TrialsHaveAllThatIsNeeded) {
  for (const char* file : {"walk/static_walk_1.trc",
                           "walk/motion_capture_walk.trc",
                           "run/paper_subject01/static_run.trc",
                           "run/hamner2010/subject02_static.trc",
                           "run/hamner2010/subject02_running.trc",
                           "run/paper_subject01/motion_capture_run.trc",
                           "run/hamner2013_subject04/run400/markers.trc"}) {
    const MarkerMapping mapping =
        mapMarkerNames(readMarkers(shared(std::string("data/") + file)).names);
    EXPECT_EQ(describeMissing(listMissingLandmarks(mapping)), "") << file;
  }
}

// Sets as laboratories write them: the body of each right or middle name; the left follows.
struct ForeignSet {
  const char* set;
  const char* names;  // "NAME body NAME body ..."
};

const ForeignSet kForeignSets[] = {
    {"plug_in_gait",
     "RFHD torso RBHD torso C7 torso T10 torso CLAV torso STRN torso RBAK torso RSHO torso "
     "RUPA humerus_r RELB humerus_r RFRM ulna_r RWRA radius_r RWRB radius_r RFIN hand_r "
     "RASI pelvis RPSI pelvis RTHI femur_r RKNE femur_r RTIB tibia_r RANK tibia_r RHEE calcn_r "
     "RTOE calcn_r"},
    {"plug_in_gait",
     "RASI pelvis SACR pelvis RTHI femur_r RKNE femur_r RTIB tibia_r RANK tibia_r RHEE calcn_r "
     "RTOE calcn_r RKAX femur_r RKD1 femur_r RKD2 femur_r RMED tibia_r"},
    {"helen_hayes",
     "Top.Head torso Front.Head torso Rear.Head torso R.Shoulder torso R.Offset torso "
     "R.Elbow humerus_r R.Wrist radius_r R.ASIS pelvis V.Sacral pelvis R.Thigh femur_r "
     "R.Knee femur_r R.Shank tibia_r R.Ankle tibia_r R.Heel calcn_r R.Toe calcn_r "
     "R.Knee.Medial femur_r R.Ankle.Medial tibia_r"},
    {"cgm2.3",
     "C7 torso T10 torso CLAV torso STRN torso RSHO torso RELB humerus_r RWRA radius_r "
     "RWRB radius_r RFIN hand_r RASI pelvis RPSI pelvis RTHI femur_r RTHAP femur_r RTHAD femur_r "
     "RKNE femur_r RKNM femur_r RTIB tibia_r RTIAP tibia_r RTIAD tibia_r RANK tibia_r RMED tibia_r "
     "RHEE calcn_r RTOE calcn_r"},
    {"cgm2.4",
     "C7 torso T10 torso CLAV torso STRN torso RASI pelvis RPSI pelvis RTHI femur_r RTHAP femur_r "
     "RTHAD femur_r RKNE femur_r RKNM femur_r RTIB tibia_r RTIAP tibia_r RTIAD tibia_r RANK "
     "tibia_r "
     "RMED tibia_r RHEE calcn_r RTOE calcn_r RSMH calcn_r RFMH calcn_r RVMH calcn_r"},
    {"opencap",
     "C7_study torso r_shoulder_study torso r.ASIS_study pelvis r.PSIS_study pelvis "
     "RHJC_study femur_r r_knee_study femur_r r_mknee_study femur_r r_ankle_study tibia_r "
     "r_mankle_study tibia_r r_calc_study calcn_r r_toe_study calcn_r r_5meta_study calcn_r "
     "r_lelbow_study humerus_r r_melbow_study humerus_r r_lwrist_study radius_r "
     "r_mwrist_study radius_r r_thigh1_study femur_r r_thigh2_study femur_r r_thigh3_study femur_r "
     "r_sh1_study tibia_r r_sh2_study tibia_r r_sh3_study tibia_r"},
    {"video_key_points",
     "Nose torso Neck torso RShoulder humerus_r RElbow ulna_r RWrist radius_r midHip pelvis "
     "RHip femur_r RKnee tibia_r RAnkle talus_r RHeel calcn_r RBigToe toes_r RSmallToe toes_r"},
    {"leardini_ior",
     "CV7 torso TV10 torso SJN torso SXS torso RCAJ torso RHLE humerus_r RHME humerus_r "
     "RRSP radius_r RUSP radius_r RHM2 hand_r RIAS pelvis RIPS pelvis RFTC femur_r RFLE femur_r "
     "RFME femur_r RFAX tibia_r RTTC tibia_r RFAL tibia_r RTAM tibia_r RFCC calcn_r RFM1 calcn_r "
     "RFM2 calcn_r RFM5 calcn_r"},
    {"human_body_model",
     "C7 torso T10 torso SACR pelvis NAVE torso XYPH torso STRN torso RSHO torso RDELT humerus_r "
     "RLEE humerus_r RMEE humerus_r RFRM ulna_r RLW radius_r RMW radius_r RFIN hand_r RASIS pelvis "
     "RPSIS pelvis RGTRO femur_r FRTHI femur_r RLEK femur_r RATI tibia_r RLM tibia_r RHEE calcn_r "
     "RTOE calcn_r RMT5 calcn_r"},
    {"vicon_iq",
     "RFHD torso RBHD torso C7 torso T10 torso CLAV torso STRN torso RBAC torso RSHO torso "
     "RUPA humerus_r RELB humerus_r RFRM ulna_r RWRA radius_r RWRB radius_r RFIN hand_r RFWT "
     "pelvis "
     "RBWT pelvis RTHI femur_r RKNE femur_r RSHN tibia_r RANK tibia_r RHEE calcn_r RTOE calcn_r "
     "RMT5 calcn_r"},
};

/// "RKNE" -> "LKNE", "r_knee" -> "L_knee", "FRTHI" -> "FLTHI"; middle names stay.
std::string toLeft(std::string name) {
  if (name == "RBAK" || name == "RBAC" || name == "Rear.Head") {
    return name;
  }
  if (name.compare(0, 3, "FRT") == 0) {
    name[1] = 'L';
  } else if (name[0] == 'R' || name.compare(0, 2, "r_") == 0 || name.compare(0, 2, "r.") == 0) {
    name[0] = 'L';
  }
  return name;
}

struct ExpectedName {
  std::string name;
  std::string body;
};

std::vector<ExpectedName> readNames(const ForeignSet& set) {
  std::vector<ExpectedName> names;
  std::istringstream words(set.names);
  std::string name;
  std::string body;
  while (words >> name >> body) {
    names.push_back({name, body});
    if (toLeft(name) != name) {
      if (body.back() == 'r' && body[body.size() - 2] == '_') {
        body.back() = 'l';
      }
      names.push_back({toLeft(name), body});
    }
  }
  return names;
}

std::vector<std::string> listNames(const std::vector<ExpectedName>& names) {
  std::vector<std::string> list;
  for (const ExpectedName& name : names) {
    list.push_back(name.name);
  }
  return list;
}

char sideLetter(Side side) {
  return side == Side::kRight ? 'R' : side == Side::kLeft ? 'L' : '-';
}

/// 'R' or 'L' where the name differs from its mirror image, else '-'.
char sideOf(const std::string& name) {
  if (name == "RBAK" || name == "RBAC") {
    return 'R';
  }
  if (toLeft(name) != name) {
    return 'R';
  }
  const bool left = name[0] == 'L' || name.compare(0, 3, "FLT") == 0;
  return left ? 'L' : '-';
}

void expectBodies(const std::vector<ExpectedName>& names, const MarkerMapping& mapping) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Landmark* landmark = findLandmark(mapping.names[i].landmark);
    ASSERT_NE(landmark, nullptr) << mapping.names[i].measured << ": " << mapping.names[i].reason;
    EXPECT_EQ(landmark->body, names[i].body) << mapping.names[i].measured;
    EXPECT_EQ(sideLetter(landmark->side), sideOf(names[i].name)) << mapping.names[i].measured;
  }
}

TEST(MarkerNames, ForeignSetsMapToBodyAndSide) {
  for (const ForeignSet& foreign : kForeignSets) {
    SCOPED_TRACE(foreign.set);
    const std::vector<ExpectedName> names = readNames(foreign);
    const MarkerMapping mapping = mapMarkerNames(listNames(names));
    EXPECT_EQ(mapping.set, foreign.set);
    EXPECT_EQ(mapping.set_share, 1.0);
    expectBodies(names, mapping);
  }
}

// A subject's name before a colon, other case and another order change nothing.
TEST(MarkerNames, PrefixCaseAndOrderDoNotMatter) {
  std::mt19937 generator(5);
  for (const ForeignSet& foreign : kForeignSets) {
    SCOPED_TRACE(foreign.set);
    std::vector<ExpectedName> names = readNames(foreign);
    std::shuffle(names.begin(), names.end(), generator);
    std::vector<std::string> written = listNames(names);
    for (std::string& name : written) {
      std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
      });
      name.insert(0, "Subject 7:");
    }
    const MarkerMapping mapping = mapMarkerNames(written);
    EXPECT_EQ(mapping.set, foreign.set);
    expectBodies(names, mapping);
  }
}

// One name, several places: the rest of the names decides.
TEST(MarkerNames, AmbiguousNamesFollowTheSet) {
  const MarkerMapping vicon = mapMarkerNames({"LASI", "RASI", "LKNE", "LANK", "LTOE", "LHEE"});
  EXPECT_EQ(landmarkOf(vicon, "LTOE"), "LMT2");
  const MarkerMapping stanford = mapMarkerNames({"LASI", "RASI", "LLFC", "LLMAL", "LTOE", "LCAL"});
  EXPECT_EQ(landmarkOf(stanford, "LTOE"), "LTOE");
  const MarkerMapping cortex = mapMarkerNames({"R.ASIS", "V.Sacral", "R.Thigh", "R.Knee", "R.Toe"});
  EXPECT_EQ(landmarkOf(cortex, "R.Toe"), "RMT2");
  const MarkerMapping walk = mapMarkerNames({"R.ASIS", "S2", "R.TH1", "R.Knee", "R.Toe"});
  EXPECT_EQ(landmarkOf(walk, "R.Toe"), "RTIP");
}

TEST(MarkerNames, WordsAreRead) {
  const struct {
    const char* written;
    const char* landmark;
  } names[] = {
      {"Right_Knee_Lateral", "RLFC"},
      {"LeftASIS", "LASI"},
      {"kneeMed.L", "LMFC"},
      {"r knee medial", "RMFC"},
      {"Right Heel", "RCAL"},
      {"lt_ankle_lat", "LLMAL"},
      {"Lateral Malleolus R", "RLMAL"},
      {"L_greater_trochanter", "LGTR"},
      {"rightAcromion", "RACR"},
      {"RightToe5thMetatarsal", ""},
      {"r_5th_metatarsal", "RMT5"},
      {"Left 1st Metatarsal", "LMT1"},
      {"Sacrum", "SACR"},
      {"R_PSIS_marker", "RPSI"},
      {"iliac crest left", "LILC"},
      {"LateralEpicondyleFemurRight", "RLFC"},
      {"M1", ""},
      {"foo", ""},
  };
  for (const auto& name : names) {
    const MarkerMapping mapping = mapMarkerNames({name.written});
    EXPECT_EQ(mapping.names[0].landmark, name.landmark) << name.written;
    EXPECT_FALSE(mapping.names[0].reason.empty());
  }
}

TEST(MarkerNames, NothingIsDropped) {
  const MarkerMapping mapping =
      mapMarkerNames({"LASI", "RASI", "LKNE", "RKNE", "LHipAngles", "PELO", "*12", "M1", ""});
  ASSERT_EQ(mapping.names.size(), 9u);
  EXPECT_EQ(mapping.listUnmapped(),
            (std::vector<std::string>{"LHipAngles", "PELO", "*12", "M1", ""}));
  EXPECT_EQ(mapping.find("*12")->reason, "has no label");
}

TEST(MarkerNames, TheSurerOfTwoIsTaken) {
  const MarkerMapping mapping = mapMarkerNames({"right knee lateral", "RLFC", "RASI", "RLMAL"});
  EXPECT_EQ(*mapping.findMeasured("RLFC"), "RLFC");
  EXPECT_EQ(mapping.find("right knee lateral")->reason, "'RLFC' is RLFC already");
}

TEST(MarkerNames, WhatIsStatedWins) {
  const MarkerOverrides stated = {{"M1", "RGTR"}, {"LKNE", std::nullopt}, {"RKNE", "LLFC"}};
  const MarkerMapping mapping = mapMarkerNames({"RKNE", "LKNE", "M1", "RASI", "LASI"}, stated);
  EXPECT_EQ(landmarkOf(mapping, "M1"), "RGTR");
  EXPECT_EQ(landmarkOf(mapping, "LKNE"), "");
  EXPECT_EQ(landmarkOf(mapping, "RKNE"), "LLFC");
  EXPECT_EQ(mapping.find("M1")->confidence, 1.0);
}

std::string refuse(const MarkerOverrides& stated) {
  try {
    mapMarkerNames({"RKNE", "LKNE"}, stated);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMarkerNames);
    return error.where().field + ": " + error.message();
  }
  return "";
}

TEST(MarkerNames, WrongStatementsAreRefused) {
  EXPECT_EQ(refuse({{"RKN", "RLFC"}}),
            "marker_names.RKN: no marker 'RKN' was measured, did you mean 'RKNE'?");
  EXPECT_EQ(refuse({{"RKNE", "RLFCC"}}),
            "marker_names.RKNE: there is no landmark 'RLFCC', did you mean 'RLFC'?");
  EXPECT_EQ(refuse({{"LKNE", "RLFC"}, {"RKNE", "RLFC"}}),
            "marker_names.RKNE: landmark 'RLFC' is given to 'LKNE' too");
}

TEST(MarkerNames, SetsNameLandmarksThatExist) {
  for (const MarkerNameSet& set : markerNameSets()) {
    std::set<std::string> names;
    for (const NamedMarker& marker : set.markers) {
      EXPECT_TRUE(names.insert(marker.name).second) << set.name << " " << marker.name;
      EXPECT_TRUE(marker.landmark.empty() || findLandmark(marker.landmark) != nullptr)
          << set.name << " " << marker.name << " " << marker.landmark;
    }
  }
}

// One knee without a lateral marker and with one marker on the thigh: that is not enough.
TEST(MarkerNames, WhatIsMissingIsNamed) {
  const std::vector<MissingLandmarks> missing = listMissingLandmarks(mapMarkerNames({"LASI",
                                                                                     "RASI",
                                                                                     "SACR",
                                                                                     "RTH1",
                                                                                     "LLFC",
                                                                                     "RLMAL",
                                                                                     "LLMAL",
                                                                                     "RCAL",
                                                                                     "RMT5",
                                                                                     "LCAL",
                                                                                     "LMT5",
                                                                                     "C7",
                                                                                     "CLAV"}));
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].part, "right knee");
}

TEST(MarkerNames, UnknownNamesMissEverything) {
  const std::vector<MissingLandmarks> missing =
      listMissingLandmarks(mapMarkerNames({"M1", "M2", "M3"}));
  ASSERT_EQ(missing.size(), 8u);
  EXPECT_EQ(missing[0].part, "pelvis");
  EXPECT_EQ(describeMissing({missing[1]}), "right knee (0 of 1, any of RLFC RMFC RFCmid RKJC)");
}

}  // namespace
}  // namespace gaitmill
