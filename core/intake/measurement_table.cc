#include "core/intake/measurement_table.h"

namespace gaitmill {

namespace {

using Axes = std::array<bool, 3>;

constexpr Axes kX = {true, false, false};
constexpr Axes kY = {false, true, false};
constexpr Axes kZ = {false, false, true};
constexpr Axes kAll = {true, true, true};
constexpr bool kFittedPose = true;

}  // namespace

const std::vector<SkeletonPoint>& skeletonPoints() {
  static const std::vector<SkeletonPoint> points = {
      {"ASIS_MID", false, {{"RASI", "LASI"}, {"ASImid"}}},
      {"PSIS_MID", false, {{"RPSI", "LPSI"}, {"PSImid"}, {"SACR"}, {"S2"}}},
      {"NOTCH", false, {{"CLAV"}, {"CLVmid"}, {"RCLV", "LCLV"}}},
      {"KNEE", true, {{"LFC", "MFC"}, {"FCmid"}, {"KJC"}}},
      {"ANKLE", true, {{"LMAL", "MMAL"}, {"MALmid"}, {"AJC"}}},
      {"ELBOW", true, {{"LEL", "MEL"}, {"ELmid"}, {"EJC"}}},
      {"WRIST", true, {{"FAradius", "FAulna"}, {"WRmid"}, {"WJC"}, {"WRI"}}},
  };
  return points;
}

const std::vector<MeasurementLine>& measurementLines() {
  static const std::vector<std::string> thigh = {"femur", "patella"};
  static const std::vector<std::string> foot = {"talus", "calcn", "toes"};
  static const std::vector<std::string> forearm = {"ulna", "radius", "hand"};
  static const std::vector<MeasurementLine> lines = {
      {"pelvis depth", "front to back of the pelvis", {{"PSIS_MID", "ASIS_MID"}}, {"pelvis"}, kX},
      {"pelvis depth", "as the width: no rear marker", {{">ASI", "<ASI"}}, {"pelvis"}, kX},
      {"pelvis width", "between the front spines", {{">ASI", "<ASI"}}, {"pelvis"}, kZ},
      {"pelvis width",
       "between the rear spines, which lie close",
       {{">PSI", "<PSI"}},
       {"pelvis"},
       kZ},
      {"pelvis width", "between measured hip centres", {{">HJC", "<HJC"}}, {"pelvis"}, kZ},
      {"pelvis width", "as the depth", {{"PSIS_MID", "ASIS_MID"}}, {"pelvis"}, kZ},
      {"pelvis height",
       "spines to measured hip centres",
       {{"ASI", "HJC"}, {"PSI", "HJC"}},
       {"pelvis"},
       kY},
      {"pelvis height",
       "as the mean of width and depth: no hip centre was measured",
       {{"PSIS_MID", "ASIS_MID"}, {">ASI", "<ASI"}},
       {"pelvis"},
       kY},
      {"thigh", "measured hip centre to knee centre", {{"HJC", "KNEE"}}, thigh, kAll},
      {"thigh", "front spine to knee centre", {{"ASI", "KNEE"}}, thigh, kAll, kFittedPose},
      {"thigh", "measured hip centre to lateral condyle", {{"HJC", "LFC"}}, thigh, kAll},
      {"thigh", "front spine to lateral condyle", {{"ASI", "LFC"}}, thigh, kAll, kFittedPose},
      {"thigh", "greater trochanter to lateral condyle", {{"GTR", "LFC"}}, thigh, kAll},
      {"shank", "knee centre to ankle centre", {{"KNEE", "ANKLE"}}, {"tibia"}, kAll, kFittedPose},
      {"shank",
       "lateral condyle to lateral malleolus",
       {{"LFC", "LMAL"}},
       {"tibia"},
       kAll,
       kFittedPose},
      {"shank",
       "knee centre to lateral malleolus",
       {{"KNEE", "LMAL"}},
       {"tibia"},
       kAll,
       kFittedPose},
      {"shank",
       "lateral condyle to ankle centre",
       {{"LFC", "ANKLE"}},
       {"tibia"},
       kAll,
       kFittedPose},
      {"foot",
       "heel to the heads of the metatarsals and the toes",
       {{"CAL", "TOE"}, {"CAL", "MT5"}, {"CAL", "MT1"}, {"CAL", "MT2"}, {"CAL", "TIP"}},
       foot,
       kAll},
      {"foot", "heel to the great toe", {{"CAL", "HLX"}}, foot, kAll, kFittedPose},
      {"foot",
       "ankle to the forefoot: no heel marker",
       {{"ANKLE", "TOE"}, {"ANKLE", "MT5"}, {"ANKLE", "MT2"}, {"LMAL", "TOE"}},
       foot,
       kAll,
       kFittedPose},
      {"foot width",
       "across the heads of the metatarsals",
       {{"TOE", "MT5"}, {"MT1", "MT5"}},
       foot,
       kZ},
      {"trunk",
       "pelvis to the base of the neck",
       {{"PSIS_MID", "NOTCH"}, {"PSIS_MID", "C7"}},
       {"torso"},
       kAll,
       kFittedPose},
      {"trunk",
       "front of the pelvis to the base of the neck",
       {{"ASIS_MID", "NOTCH"}, {"ASIS_MID", "C7"}},
       {"torso"},
       kAll,
       kFittedPose},
      {"trunk", "pelvis to the shoulders", {{"PSIS_MID", "ACR"}}, {"torso"}, kAll, kFittedPose},
      {"trunk",
       "front of the pelvis to the shoulders",
       {{"ASI", "ACR"}},
       {"torso"},
       kAll,
       kFittedPose},
      {"trunk width", "between the shoulders", {{">ACR", "<ACR"}}, {"torso"}, kZ},
      {"trunk width", "between measured shoulder centres", {{">SJC", "<SJC"}}, {"torso"}, kZ},
      {"upper arm", "shoulder centre to elbow centre", {{"SJC", "ELBOW"}}, {"humerus"}, kAll},
      {"upper arm", "acromion to elbow centre", {{"ACR", "ELBOW"}}, {"humerus"}, kAll, kFittedPose},
      {"upper arm", "shoulder centre to lateral epicondyle", {{"SJC", "LEL"}}, {"humerus"}, kAll},
      {"upper arm",
       "acromion to lateral epicondyle",
       {{"ACR", "LEL"}},
       {"humerus"},
       kAll,
       kFittedPose},
      {"forearm", "elbow centre to wrist", {{"ELBOW", "WRIST"}}, forearm, kAll, kFittedPose},
      {"forearm", "lateral epicondyle to wrist", {{"LEL", "WRIST"}}, forearm, kAll, kFittedPose},
  };
  return lines;
}

const std::vector<GroupLimit>& groupLimits() {
  // Shoe soles, and shoulders that rise with the arms, measure badly (spec/scale.md 7.1).
  static const std::vector<GroupLimit> limits = {
      {"foot width", "foot", 1 / 1.15, 1.15},
      {"trunk width", "trunk", 1 / 1.15, 1.15},
  };
  return limits;
}

}  // namespace gaitmill
