#include "core/figure/job_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/memory_results.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Tables = std::map<std::string, TimeSeries>;

// One right cycle from 0.2 to 1.2 s, the left one half a second later, toe-offs at 60 %.
constexpr const char* kOneCycle = R"({
  "subject": {"mass_kg": 70, "height_m": 1.76},
  "gait_cycle_s": [0.2, 1.2],
  "cycles": {"right": [[0.2, 1.2]], "left": [[0.7, 1.7]]},
  "events": [{"kind": "foot_strike", "foot": "right", "time_s": 0.2},
             {"kind": "toe_off", "foot": "left", "time_s": 0.3},
             {"kind": "toe_off", "foot": "right", "time_s": 0.8},
             {"kind": "foot_strike", "foot": "left", "time_s": 0.7}],
  "quality": {"checks": [{"figure": "residual_force_peak", "limit": 40, "unit": "N",
                          "source": "Hicks et al. 2015"}]}})";

double wave(double time) {
  return std::sin(2 * kPi * time);
}

// Rows from 0 to 2 s; columns by formula.
TimeSeries makeTable(const std::map<std::string, std::function<double(double)>>& columns,
                     const std::string& unit) {
  TimeSeries table;
  for (int i = 0; i <= 200; ++i) {
    table.time.push_back(0.01 * i);
  }
  table.values.resize(table.rowCount(), static_cast<Eigen::Index>(columns.size()));
  Eigen::Index column = 0;
  for (const auto& [label, formula] : columns) {
    table.labels.push_back(label);
    table.units.push_back(unit);
    for (int row = 0; row < table.rowCount(); ++row) {
      table.values(row, column) = formula(table.time[static_cast<std::size_t>(row)]);
    }
    ++column;
  }
  return table;
}

MemoryResults makeResults(Tables tables, const std::string& summary = kOneCycle) {
  return MemoryResults(std::move(tables), {}, summary);
}

const Series& findSeries(const Panel& panel, const std::string& name, SeriesMark mark) {
  const auto found =
      std::find_if(panel.series.begin(), panel.series.end(), [&](const Series& series) {
        return series.name == name && series.mark == mark;
      });
  require(found != panel.series.end(), ErrorCode::kInternal, "no series " + name);
  return *found;
}

TEST(JobFigures, AreThoseWhoseTablesTheJobHas) {
  const MemoryResults results = makeResults({{"kinematics", makeTable({{"q_r", wave}}, "rad")}});
  const std::vector<FigureInfo> figures = listFigures(results);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures.front().name, "joint_angles");
  EXPECT_FALSE(figures.front().caption.empty());
}

TEST(JobFigures, UnknownNamesAreAnsweredWithTheNearest) {
  const MemoryResults results = makeResults({{"kinematics", makeTable({{"q_r", wave}}, "rad")}});
  try {
    makeFigure(results, "joint_angels");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFigureNotFound);
    EXPECT_NE(error.message().find("did you mean 'joint_angles'"), std::string::npos);
  }
}

// The left knee does what the right one does half a second later, so that over its own cycle it
// looks the same.
TEST(JobFigures, EachSideIsShownOverItsOwnCycleInDegrees) {
  const MemoryResults results = makeResults({{"kinematics",
                                              makeTable({{"knee_angle_r",
                                                          [](double t) {
                                                            return wave(t - 0.2);
                                                          }},
                                                         {"knee_angle_l",
                                                          [](double t) {
                                                            return wave(t - 0.7);
                                                          }}},
                                                        "rad")}});
  const Figure figure = makeFigure(results, "joint_angles");
  ASSERT_EQ(figure.panels.size(), 1U);
  const Panel& panel = figure.panels.front();
  EXPECT_EQ(panel.title, "Knee flexion");
  EXPECT_EQ(panel.y.unit, "deg");
  const Series& right = findSeries(panel, "right", SeriesMark::kLine);
  const Series& left = findSeries(panel, "left", SeriesMark::kLine);
  ASSERT_EQ(right.x.size(), 101U);
  for (std::size_t i = 0; i < right.y.size(); ++i) {
    EXPECT_NEAR(right.y[i], kDegreesPerRadian * wave(0.01 * static_cast<double>(i)), tol(1e-9));
    EXPECT_NEAR(left.y[i], right.y[i], tol(1e-9));
  }
}

// 0.8 s is 60 % of the right cycle; the left toe-off at 0.3 s is one cycle before 1.3 s: 60 %.
TEST(JobFigures, ToeOffIsMarkedOnceWhereBothSidesAgree) {
  const MemoryResults results = makeResults(
      {{"kinematics", makeTable({{"knee_angle_r", wave}, {"knee_angle_l", wave}}, "rad")}});
  const Panel panel = makeFigure(results, "joint_angles").panels.front();
  ASSERT_EQ(panel.guides.size(), 1U);
  EXPECT_NEAR(panel.guides.front().value, 60, tol(1e-9));
  EXPECT_EQ(panel.guides.front().label, "toe-off");
}

// Two cycles of 0.5 s with the values 1 and 3: mean 2, standard deviation sqrt(2).
TEST(JobFigures, SeveralCyclesGiveMeanAndStandardDeviation) {
  const char* summary = R"({"gait_cycle_s": [0.5, 1.0],
                            "cycles": {"right": [[0.5, 1.0], [1.0, 1.5]], "left": []}})";
  const auto step = [](double t) {
    return t < 0.9999 ? 1.0 : 3.0;
  };
  const MemoryResults results =
      makeResults({{"activations", makeTable({{"soleus_r", step}}, "")}}, summary);
  const Panel panel = makeFigure(results, "activations").panels.front();
  EXPECT_EQ(panel.title, "Soleus");
  const Series& mean = findSeries(panel, "right", SeriesMark::kLine);
  const Series& band = findSeries(panel, "right", SeriesMark::kBand);
  EXPECT_NEAR(mean.y[50], 2, tol(1e-12));
  EXPECT_NEAR(band.y[50], 2 + std::sqrt(2.0), tol(1e-12));
  EXPECT_NEAR(band.low[50], 2 - std::sqrt(2.0), tol(1e-12));
}

TEST(JobFigures, WithoutCycleTimeIsTheAxis) {
  const MemoryResults results =
      makeResults({{"activations", makeTable({{"soleus_r", wave}}, "")}}, "{}");
  const Panel panel = makeFigure(results, "activations").panels.front();
  EXPECT_EQ(panel.x.unit, "s");
  const Series& curve = findSeries(panel, "right", SeriesMark::kLine);
  EXPECT_EQ(curve.x.front(), 0);
  EXPECT_EQ(curve.x.back(), 2);
}

// The muscles fall 1 N.m short everywhere: RMS and largest difference are 1 of a peak of 10.
TEST(JobFigures, MomentsStateTheDifferenceToInverseDynamics) {
  const MemoryResults results = makeResults({{"moments",
                                              makeTable({{"knee_angle_r_moment",
                                                          [](double t) {
                                                            return 10 * wave(t - 0.2);
                                                          }},
                                                         {"knee_angle_r_muscle_moment",
                                                          [](double t) {
                                                            return 10 * wave(t - 0.2) - 1;
                                                          }},
                                                         {"lumbar_extension_moment", wave},
                                                         {"pelvis_tilt_moment", wave}},
                                                        "N.m")}});
  const Figure figure = makeFigure(results, "moments");
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].title, "Right knee flexion");
  EXPECT_EQ(figure.panels[0].note, "RMS difference 1 N·m, largest 1 N·m (10.0 % of the peak)");
  EXPECT_EQ(figure.panels[1].title, "Lumbar extension");
}

TEST(JobFigures, PaperFigure4TurnsKneeAndAnkleRound) {
  const auto two = [](double) {
    return 2.0;
  };
  Tables tables;
  tables["moments"] = makeTable({{"hip_flexion_r_moment", two},
                                 {"hip_flexion_r_muscle_moment", two},
                                 {"knee_angle_r_moment", two},
                                 {"knee_angle_r_muscle_moment", two},
                                 {"ankle_angle_r_moment", two},
                                 {"ankle_angle_r_muscle_moment", two}},
                                "N.m");
  const Figure figure = makeFigure(makeResults(tables), "paper_figure_4");
  ASSERT_EQ(figure.panels.size(), 3U);
  const double expected[] = {2, -2, -2};
  for (std::size_t i = 0; i < 3; ++i) {
    const Series& muscles = findSeries(figure.panels[i], "muscles", SeriesMark::kLine);
    EXPECT_EQ(muscles.y[40], expected[i]) << figure.panels[i].title;
  }
}

TEST(JobFigures, ResidualsAreHeldAgainstTheLimitOfTheSummary) {
  const MemoryResults results = makeResults({{"residuals", makeTable({{"FX", wave}}, "N")}});
  const Figure figure = makeFigure(results, "residuals");
  ASSERT_EQ(figure.panels.size(), 1U);
  const std::vector<Guide>& guides = figure.panels.front().guides;
  ASSERT_GE(guides.size(), 2U);
  EXPECT_EQ(guides[0].value, 40);
  EXPECT_EQ(guides[1].value, -40);
  EXPECT_NE(guides[0].label.find("Hicks et al. 2015"), std::string::npos);
}

// 3-4-12 makes 13; one body weight is 70 g. On the left leg, lateral is where z is negative.
TEST(JobFigures, JointReactionsComeInBodyWeights) {
  const double weight = 70 * kGravity;
  const auto constant = [&](double value) {
    return [value, weight](double) {
      return value * weight;
    };
  };
  Tables tables;
  tables["joint_reactions"] = makeTable({{"hip_l_on_femur_l_in_femur_l_fx", constant(3)},
                                         {"hip_l_on_femur_l_in_femur_l_fy", constant(-12)},
                                         {"hip_l_on_femur_l_in_femur_l_fz", constant(-4)}},
                                        "N");
  const Figure figure = makeFigure(makeResults(tables), "joint_reactions");
  ASSERT_EQ(figure.panels.size(), 4U);
  const double expected[] = {13, 3, 12, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    const Series& left = findSeries(figure.panels[i], "left", SeriesMark::kLine);
    EXPECT_NEAR(left.y[10], expected[i], tol(1e-12)) << figure.panels[i].title;
    EXPECT_EQ(figure.panels[i].y.unit, "BW");
  }
}

// An electromyogram of 5 at its peak beside an activation of 0.4: scaled by 0.08.
TEST(JobFigures, ElectromyogramsPeakWhereActivationsDo) {
  const char* summary = R"({"gait_cycle_s": [0.2, 1.2],
    "emg": {"channels": [{"channel": "SOL", "muscles": ["soleus_r"], "side": "right"}],
            "electromechanical_delay_s": 0.05}})";
  Tables tables;
  tables["activations"] = makeTable({{"soleus_r",
                                      [](double t) {
                                        return 0.2 + 0.2 * wave(t);
                                      }}},
                                    "");
  tables["emg"] = makeTable({{"SOL",
                              [](double t) {
                                return 2.5 + 2.5 * wave(t);
                              }}},
                            "mV");
  const Figure figure = makeFigure(makeResults(tables, summary), "activations_emg");
  ASSERT_EQ(figure.panels.size(), 1U);
  const Panel& panel = figure.panels.front();
  EXPECT_EQ(panel.title, "Soleus, right (SOL)");
  const Series& emg = findSeries(panel, "electromyogram, scaled", SeriesMark::kLine);
  EXPECT_NEAR(*std::max_element(emg.y.begin(), emg.y.end()), 0.4, tol(1e-9));
  EXPECT_NE(figure.caption.find("50 ms later"), std::string::npos);
}

TEST(JobFigures, ChannelsAreNamedByTheirMuscles) {
  const char* summary = R"({"emg": {"channels": [
    {"channel": "GMAX", "muscles": ["glmax1_l", "glmax2_l"], "side": "left"},
    {"channel": "MH", "muscles": ["semimem_r", "semiten_r"], "side": "right"}]}})";
  Tables tables;
  tables["activations"] = makeTable(
      {{"glmax1_l", wave}, {"glmax2_l", wave}, {"semimem_r", wave}, {"semiten_r", wave}}, "");
  tables["emg"] = makeTable({{"GMAX", wave}, {"MH", wave}}, "mV");
  const Figure figure = makeFigure(makeResults(tables, summary), "activations_emg");
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].title, "Gluteus maximus, left (GMAX)");
  EXPECT_EQ(figure.panels[1].title, "Semimembranosus, semitendinosus, right (MH)");
}

// Channels are found by their muscles; a muscle without channel shows its activation alone.
TEST(JobFigures, PaperFigure5HasTheEightGroups) {
  const char* summary = R"({"gait_cycle_s": [0.2, 1.2],
    "emg": {"channels": [{"channel": "A1", "muscles": ["glmax1_r", "glmax2_r"], "side": "right"}],
            "comparison": [{"channel": "A1", "overlap": 0.85, "correlation": 0.931,
                            "lag_percent": 2}]}})";
  std::map<std::string, std::function<double(double)>> columns;
  for (const char* muscle :
       {"glmed1_r", "recfem_r", "vaslat_r", "bflh_r", "gaslat_r", "tibant_r", "soleus_r"}) {
    columns[muscle] = [](double) {
      return 0.1;
    };
  }
  columns["glmax1_r"] = [](double) {
    return 0.2;
  };
  columns["glmax2_r"] = [](double) {
    return 0.4;
  };
  Tables tables;
  tables["activations"] = makeTable(columns, "");
  tables["emg"] = makeTable({{"A1",
                              [](double t) {
                                return 2 + wave(t);
                              }}},
                            "mV");
  const Figure figure = makeFigure(makeResults(tables, summary), "paper_figure_5");
  ASSERT_EQ(figure.panels.size(), 8U);
  EXPECT_EQ(figure.panels[0].title, "Gluteus maximus");
  EXPECT_EQ(figure.panels[0].note,
            "on and off alike 85 % of the cycle; correlation 0.93 at a lag of 2 %");
  const Series& mean = findSeries(figure.panels[0], "simulated activation", SeriesMark::kLine);
  EXPECT_NEAR(mean.y[50], 0.3, tol(1e-12));
  EXPECT_EQ(figure.panels[0].series.size(), 2U);
  EXPECT_EQ(figure.panels[7].title, "Soleus");
  EXPECT_EQ(figure.panels[7].series.size(), 1U);
}

TEST(JobFigures, MusclePartsAddUp) {
  Tables tables;
  tables["muscle_moments"] = makeTable({{"hip_flexion_l_muscle_moment",
                                         [](double) {
                                           return 5.0;
                                         }},
                                        {"hip_flexion_l_active_moment",
                                         [](double) {
                                           return 3.0;
                                         }},
                                        {"hip_flexion_l_passive_moment",
                                         [](double) {
                                           return 2.0;
                                         }}},
                                       "N.m");
  const Figure figure = makeFigure(makeResults(tables), "moments_active_passive");
  ASSERT_EQ(figure.panels.size(), 1U);
  const Panel& panel = figure.panels.front();
  EXPECT_EQ(panel.title, "Left hip flexion");
  EXPECT_EQ(findSeries(panel, "total", SeriesMark::kLine).y[10],
            findSeries(panel, "active", SeriesMark::kLine).y[10] +
                findSeries(panel, "passive", SeriesMark::kLine).y[10]);
}

TEST(JobFigures, WorkOfBothSignsStandsInOnePlace) {
  TimeSeries work;
  work.labels = {"soleus_r_fiber_positive_work",
                 "soleus_r_fiber_negative_work",
                 "soleus_r_tendon_positive_work",
                 "soleus_r_tendon_negative_work",
                 "soleus_r_net_work"};
  work.time = {0.2, 1.2};
  work.values = RowMatrix(2, 5);
  work.values << 1, -2, 3, -4, 5, 3, -4, 5, -6, 7;
  const Figure figure = makeFigure(makeResults({{"muscle_work", work}}), "muscle_work");
  ASSERT_EQ(figure.panels.size(), 3U);
  const Series& positive = figure.panels[0].series[0];
  EXPECT_EQ(positive.categories, (std::vector<std::string>{"Soleus"}));
  EXPECT_EQ(positive.y, (std::vector<double>{2}));
  EXPECT_NE(figure.caption.find("Mean of 2 cycles"), std::string::npos);
}

TEST(JobFigures, MarkerErrorsAreRankedAndMissingOnesLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MemoryResults results = makeResults({{"marker_errors",
                                              makeTable({{"A",
                                                          [](double) {
                                                            return 0.01;
                                                          }},
                                                         {"B",
                                                          [](double) {
                                                            return 0.02;
                                                          }},
                                                         {"C",
                                                          [nan](double) {
                                                            return nan;
                                                          }}},
                                                        "m")}});
  const Panel panel = makeFigure(results, "marker_errors").panels.front();
  EXPECT_EQ(panel.series[0].categories, (std::vector<std::string>{"B", "A"}));
  EXPECT_NEAR(panel.series[0].y[0], 2, tol(1e-12));
}

}  // namespace
}  // namespace gaitmill
