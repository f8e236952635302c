#include "core/validation/curve_figures.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const Series& findSeries(const Figure& figure, const std::string& panel, std::size_t index) {
  const auto found = std::find_if(figure.panels.begin(),
                                  figure.panels.end(),
                                  [&panel](const Panel& one) { return one.name == panel; });
  EXPECT_NE(found, figure.panels.end()) << panel;
  return found->series.at(index);
}

double interpolate(const Series& series, double x) {
  const auto upper = std::lower_bound(series.x.begin(), series.x.end(), x);
  EXPECT_TRUE(upper != series.x.begin() && upper != series.x.end()) << x;
  const auto i = static_cast<std::size_t>(upper - series.x.begin());
  const double share = (x - series.x[i - 1]) / (series.x[i] - series.x[i - 1]);
  return series.y[i - 1] + share * (series.y[i] - series.y[i - 1]);
}

struct TableRow {
  double x;
  double y;
};

void expectRows(const Series& series, const std::vector<TableRow>& rows) {
  for (const TableRow& row : rows) {
    // Between samples the drawn curve is straight.
    EXPECT_NEAR(interpolate(series, row.x), row.y, tol(1e-3)) << series.name << " " << row.x;
  }
}

// Rows of spec/muscle.md 11.4, 11.5, 11.8, 11.9.
TEST(CurveFigures, DrawTheCurvesOfTheModel) {
  const Figure figure = makeForceLengthVelocityFigure(readOwnModel());
  ASSERT_EQ(figure.panels.size(), 3u);
  expectRows(findSeries(figure, "force_length", 0),
             {{0.7, 0.800676839185}, {0.9, 0.962436924069}, {1, 1}, {1.3, 0.718600513879}});
  expectRows(findSeries(figure, "force_length", 1),
             {{1, 0}, {1.2, 0.0496920302056}, {1.45, 0.353439618787}, {1.7, 1}});
  expectRows(findSeries(figure, "force_velocity", 0),
             {{-0.5, 0.158085604442}, {-0.1, 0.625214284313}, {0.1, 1.22515383775}, {1.05, 1.4}});
  expectRows(findSeries(figure, "tendon_force_strain", 0),
             {{0.5, 0.0376044936314}, {2, 0.260935982615}, {3.5, 0.607471506785}, {4.9, 1}});
  EXPECT_NE(figure.caption.find("80 of the model's 80"), std::string::npos);
}

TEST(CurveFigures, MuscleIsInItsOwnUnits) {
  const ModelSpec model = readOwnModel();
  const MuscleIndex soleus(model.findMuscle("soleus_r"));
  const Figure figure = makeMuscleCurvesFigure(model, soleus);
  EXPECT_EQ(figure.name, "muscle_curves_soleus_r");
  ASSERT_EQ(figure.panels.size(), 4u);
  const double force = 6194.84262295082;  // rajagopal2016.md 7: F0M, l0M 4.4 cm, lsT 27.6755872 cm
  EXPECT_NEAR(interpolate(findSeries(figure, "force_length", 0), 4.4), force, tol(1e-3) * force);
  EXPECT_NEAR(interpolate(findSeries(figure, "force_velocity", 0), 0.0001), force, 1e-3 * force);
  EXPECT_NEAR(interpolate(findSeries(figure, "tendon_force_length", 0), 27.6755872 * 1.049),
              force,
              tol(1e-3) * force);
  // Static equilibrium of spec/muscle.md 12: path 0.33 m at activation 1.
  EXPECT_NEAR(
      interpolate(findSeries(figure, "isometric_force", 0), 33.0), 5741.059413, tol(1e-3) * force);
}

TEST(CurveFigures, RigidTendonHasNoCurve) {
  const ModelSpec model = readOwnModel();
  const Figure figure = makeMuscleCurvesFigure(model, MuscleIndex(model.findMuscle("psoas_r")));
  EXPECT_EQ(figure.panels.size(), 3u);
}

}  // namespace
}  // namespace gaitmill
