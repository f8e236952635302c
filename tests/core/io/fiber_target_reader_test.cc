#include "core/io/fiber_target_reader.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

struct Refusal {
  std::string text;
  ErrorCode code;
  int line;
  int column;
};

TEST(FiberTargets, RowsGiveOneOfTwoLengths) {
  const auto targets = readFiberTargets(
      "# from a table\nmuscle, norm_fiber_length, fiber_length_m\nsoleus, 0.785,\n\n"
      "semimem_r,, 0.0713\n",
      "targets.csv");
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[0].muscle, "soleus");
  EXPECT_EQ(targets[0].norm_fiber_length, 0.785);
  EXPECT_TRUE(std::isnan(targets[0].fiber_length));
  EXPECT_EQ(targets[0].line, 3);
  EXPECT_EQ(targets[1].muscle, "semimem_r");
  EXPECT_TRUE(std::isnan(targets[1].norm_fiber_length));
  EXPECT_EQ(targets[1].fiber_length, 0.0713);
  EXPECT_EQ(targets[1].line, 5);
}

TEST(FiberTargets, FaultsAreNamedWithTheirPlace) {
  const Refusal refusals[] = {
      {"", ErrorCode::kFileEmpty, 0, 0},
      {"muscle,length\nsoleus,1\n", ErrorCode::kTableLabels, 1, 8},
      {"muscle\nsoleus\n", ErrorCode::kTableLabels, 1, 1},
      {"muscle,muscle,fiber_length_m\n", ErrorCode::kTableDuplicateLabel, 1, 8},
      {"muscle,fiber_length_m\n", ErrorCode::kTableNoRows, 1, 1},
      {"muscle,fiber_length_m\nsoleus,1,2\n", ErrorCode::kTableColumnCount, 2, 1},
      {"muscle,fiber_length_m\nsoleus,long\n", ErrorCode::kTableNumber, 2, 8},
      {"muscle,fiber_length_m\nsoleus,inf\n", ErrorCode::kTableNumber, 2, 8},
      {"muscle,fiber_length_m\nsoleus,-0.1\n", ErrorCode::kInputValue, 2, 8},
      {"muscle,fiber_length_m\nsoleus,\n", ErrorCode::kInputValue, 2, 1},
      {"muscle,fiber_length_m\n,0.1\n", ErrorCode::kInputValue, 2, 1},
      {"muscle,fiber_length_m,norm_fiber_length\nsoleus,0.04,1\n", ErrorCode::kInputValue, 2, 1},
  };
  for (const Refusal& refusal : refusals) {
    try {
      readFiberTargets(refusal.text, "targets.csv");
      ADD_FAILURE() << refusal.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), refusal.code) << refusal.text << error.what();
      EXPECT_EQ(error.where().file, "targets.csv");
      EXPECT_EQ(error.where().line, refusal.line) << refusal.text;
      EXPECT_EQ(error.where().column, refusal.column) << refusal.text;
    }
  }
}

}  // namespace
}  // namespace gaitmill
