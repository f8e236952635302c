#include "service/model_command.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const char* const kDocument = "models/rajagopal2016/rajagopal2016.osim";

TEST(ModelCommand, JsonHoldsTheMusclesOfTableTwo) {
  const nlohmann::json model = nlohmann::json::parse(describeModel(kDocument, ModelReport::kJson));
  EXPECT_EQ(model["counts"]["muscles"], 80);
  EXPECT_EQ(model["counts"]["rigid_tendons"], 34);
  EXPECT_EQ(model["muscles"].size(), 80u);
  EXPECT_EQ(model["coordinates"].size(), 39u);
  const nlohmann::json& first = model["muscles"][0];
  EXPECT_EQ(first["name"], "addbrev_r");
  EXPECT_EQ(first["optimal_fiber_length_m"], 0.1031);
  EXPECT_NEAR(first["pennation_at_optimal_deg"].get<double>(), 6.6, tol(0.05));
}

TEST(ModelCommand, TableIsForPeople) {
  const std::string text = describeModel(kDocument, ModelReport::kTable);
  EXPECT_NE(text.find("Muscle            F0M [N]"), std::string::npos);
  EXPECT_NE(text.find("vaslat"), std::string::npos);
}

TEST(ModelCommand, AbsentFileIsNamed) {
  EXPECT_THROW(describeModel("models/absent.osim", ModelReport::kTable), Error);
}

}  // namespace
}  // namespace gaitmill
