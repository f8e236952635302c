#include "core/validation/validation.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/model_files.h"

namespace gaitmill {
namespace {

TEST(ValidationFigures, EveryListedFigureCanBeMadeAndIsWhole) {
  const ModelSpec model = readOwnModel();
  std::set<std::string> names;
  for (const FigureInfo& info : listValidationFigures(model)) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.title.empty());
    EXPECT_FALSE(info.caption.empty());
    const Figure figure = makeValidationFigure(model, info.name);
    EXPECT_EQ(figure.name, info.name);
    EXPECT_FALSE(figure.caption.empty());
    ASSERT_FALSE(figure.panels.empty()) << info.name;
    std::set<std::string> panels;
    for (const Panel& panel : figure.panels) {
      EXPECT_TRUE(panels.insert(panel.name).second) << info.name << " " << panel.name;
      EXPECT_FALSE(panel.title.empty() || panel.y.label.empty()) << info.name;
      ASSERT_FALSE(panel.series.empty()) << info.name << " " << panel.name;
      for (const Series& series : panel.series) {
        const bool bars = series.mark == SeriesMark::kBars;
        EXPECT_FALSE(series.y.empty()) << info.name << " " << series.name;
        EXPECT_EQ(series.y.size(), bars ? series.categories.size() : series.x.size())
            << info.name << " " << panel.name << " " << series.name;
      }
    }
  }
  EXPECT_EQ(names.count("knee_moment_arms"), 1u);
  EXPECT_EQ(names.count("muscle_curves_soleus_r"), 1u);
}

TEST(ValidationFigures, UnknownNameIsRefusedWithTheOnesThereAre) {
  const ModelSpec model = readOwnModel();
  for (const char* name : {"elbow_moment_arms", "muscle_curves_", "muscle_curves_nobody_r", ""}) {
    try {
      makeValidationFigure(model, name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kFigureNotFound);
      EXPECT_NE(error.message().find("hip_moment_arms"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace gaitmill
