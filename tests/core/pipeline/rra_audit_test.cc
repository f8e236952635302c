#include "core/pipeline/rra_audit.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/io/files.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

RraPassResult makePass(double weight, double merit) {
  RraPassResult pass;
  pass.used = {0.5, 1.5, {{"pelvis_tx", weight}}};
  pass.merit = merit;
  pass.decision = "as told";
  CoordinateDeviation deviation;
  deviation.coordinate = "pelvis_tx";
  deviation.translation = true;
  deviation.rms = 0.03;
  deviation.peak = 0.04;
  deviation.share = 1.5;
  pass.deviations = {deviation};
  return pass;
}

RraResult makeResult() {
  RraResult rra;
  rra.options.strategy = RraStrategy::kAutopilot;
  rra.passes = {makePass(100, 0.5), makePass(250, 0.7)};
  rra.passes[1].from_pass = 1;
  rra.passes[1].weight_changes = {{"pelvis_tx", 100, 250, "strays to 150 % of its limit"}};
  rra.kept = 0;
  rra.mass_steps.resize(2);
  rra.warnings = {"limits do not hold"};
  return rra;
}

TEST(RraAudit, SaysOfEveryPassWhatWasChangedAndWhy) {
  const nlohmann::ordered_json audit = auditRra(makeResult());
  EXPECT_EQ(audit["strategy"], "autopilot");
  EXPECT_EQ(audit["kept_pass"], 1);
  EXPECT_FALSE(audit["limits_hold"].get<bool>());
  EXPECT_EQ(audit["mass_steps"].size(), 2U);
  EXPECT_EQ(audit["warnings"][0], "limits do not hold");
  EXPECT_NEAR(audit["limits"]["rotation_rms_deg"].get<double>(), 2, tol(1e-12));
  const auto& second = audit["passes"][1];
  EXPECT_EQ(second["pass"], 2);
  EXPECT_EQ(second["from_pass"], 1);
  EXPECT_TRUE(audit["passes"][0]["from_pass"].is_null());
  EXPECT_EQ(second["weights"]["pelvis_tx"], 250);
  EXPECT_EQ(second["weight_changes"][0]["before"], 100);
  EXPECT_EQ(second["weight_changes"][0]["reason"], "strays to 150 % of its limit");
  EXPECT_EQ(second["decision"], "as told");
  EXPECT_NEAR(second["deviations"]["pelvis_tx"]["rms_cm"].get<double>(), 3, tol(1e-12));
  ASSERT_EQ(second["exceeded"].size(), 1U);
  EXPECT_EQ(second["exceeded"][0]["figure"], "pelvis_tx RMS");
}

TEST(RraAudit, PassesInShortHaveTrackingWithoutTheirTables) {
  const nlohmann::ordered_json passes = summarizeRraPasses(makeResult());
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_NEAR(passes[0]["tracking"]["max_cm"].get<double>(), 4, tol(1e-12));
  EXPECT_EQ(passes[0]["tracking"]["worst_translation"], "pelvis_tx");
  EXPECT_TRUE(passes[0]["tracking"]["max_deg"].is_null());
  EXPECT_EQ(passes[1]["weights_changed"], 1);
}

// From the files to the audit, and what the summary says is what can be downloaded.
TEST(RraAudit, OfTheSampleTrialIsCompleteAndEqualInSummaryAndFile) {
  nlohmann::json settings = nlohmann::json::parse(readFile("models/settings/default.json"));
  settings["stages"] = {{"last", "rra"}};
  const PipelineResult result =
      Pipeline().run(readSampleInput(), {"settings.json", settings.dump()}, {});
  const auto summary = nlohmann::json::parse(result.summary_json);
  const auto file = nlohmann::json::parse(result.files.at("rra_audit.json"));
  EXPECT_EQ(summary["rra"], file);
  EXPECT_EQ(file["strategy"], "autopilot");
  EXPECT_TRUE(file["limits_hold"].get<bool>());
  EXPECT_EQ(file["passes"].size(), summary["rra_passes"].size());
  const auto& pass = file["passes"][0];
  EXPECT_EQ(pass["weights"].size(), 29U);
  EXPECT_EQ(pass["deviations"].size(), 29U);
  for (const char* when : {"residuals_before", "residuals_after"}) {
    const double rms = pass[when]["rms"]["force_n"][1].get<double>();
    EXPECT_GT(rms, 0) << when;
    EXPECT_LT(rms, file["limits"]["force_rms_n"].get<double>()) << when;
  }
  double mass = pass["adjustment"]["mass_before_kg"].get<double>();
  for (const auto& step : file["mass_steps"]) {
    EXPECT_NEAR(step["mass_before_kg"].get<double>(), mass, tol(1e-9));
    mass += step["mass_change_kg"].get<double>();
  }
  EXPECT_NEAR(pass["adjustment"]["mass_before_kg"].get<double>() +
                  pass["adjustment"]["mass_change_kg"].get<double>(),
              mass,
              tol(1e-9));
}

}  // namespace
}  // namespace gaitmill
