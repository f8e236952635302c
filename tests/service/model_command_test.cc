#include "service/model_command.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "tests/support/temporary_folder.h"
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

TEST(CalibrateCommand, ShowsWhereTheModelRestsWithoutTargets) {
  CalibrateOptions options;
  options.path = kDocument;
  const std::string text = calibrateModel(options);
  EXPECT_NE(text.find("soleus_r            0.7857 ."), std::string::npos) << text;
  EXPECT_EQ(text.find("written"), std::string::npos);
}

TEST(CalibrateCommand, WritesTheCalibratedModel) {
  const TemporaryFolder folder;
  CalibrateOptions options;
  options.path = kDocument;
  options.targets = folder.path() + "/targets.csv";
  options.out = folder.path() + "/calibrated.osim";
  writeFile(options.targets, "muscle,norm_fiber_length\nsoleus,0.9\n");
  const std::string text = calibrateModel(options);
  EXPECT_NE(text.find("0 of 2 calibrated slack lengths are within 1 mm"), std::string::npos)
      << text;
  const ModelSpec before = readOsim(readFile(kDocument), kDocument);
  const ModelSpec after = readOsim(readFile(options.out), options.out);
  for (std::size_t m = 0; m < before.muscles.size(); ++m) {
    const double change =
        after.muscles[m].tendon_slack_length - before.muscles[m].tendon_slack_length;
    const bool is_soleus = before.muscles[m].name.compare(0, 6, "soleus") == 0;
    // Fibers of 4.4 cm become 11 % longer, so the tendon some 5 mm shorter.
    EXPECT_NEAR(change, is_soleus ? -0.0052 : 0.0, is_soleus ? tol(5e-4) : 0.0)
        << before.muscles[m].name;
  }
}

TEST(CalibrateCommand, FaultsOfTargetsNameFileAndLine) {
  const TemporaryFolder folder;
  CalibrateOptions options;
  options.path = kDocument;
  options.targets = folder.path() + "/targets.csv";
  writeFile(options.targets, "muscle,norm_fiber_length\nsoleus,0.9\ndeltoid,1\n");
  try {
    calibrateModel(options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.where().file, options.targets);
    EXPECT_EQ(error.where().line, 3);
  }
}

}  // namespace
}  // namespace gaitmill
