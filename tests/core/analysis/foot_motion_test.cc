#include "core/analysis/foot_motion.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(FindFootOfMarker, KnowsTheUsualNames) {
  for (const char* right :
       {"RHEE", "R.Heel", "RTOE", "RMT5", "lab:RANK", "R_MMAL", "RLMAL", "heel_r", "RCAL"}) {
    EXPECT_EQ(findFootOfMarker(right), Foot::kRight) << right;
  }
  for (const char* left : {"LHEE", "L.Toe", "LMT1", "ankle_l", "LLMAL", "LCAL"}) {
    EXPECT_EQ(findFootOfMarker(left), Foot::kLeft) << left;
  }
  for (const char* other :
       {"RASI", "LCLAV", "C7", "RTH1", "SACR", "", "R", "LFAsuperior", "STRN"}) {
    EXPECT_EQ(findFootOfMarker(other), Foot::kUnknown) << other;
  }
}

}  // namespace
}  // namespace gaitmill
