#include "core/report/report.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/core/report/memory_results.h"

namespace gaitmill {
namespace {

constexpr const char* kSummary = R"({
  "verdict": "warn",
  "subject": {"mass_kg": 70, "height_m": 1.76},
  "quality": {
    "checks": [
      {"stage": "ik", "figure": "marker_error_rms", "worst": "", "value": 1.2, "unit": "cm",
       "limit": 2, "fail_above": 4, "source": "OpenSim checklist", "verdict": "pass",
       "meaning": "inverse kinematics misses the markers by an RMS of up to"},
      {"stage": "ik", "figure": "marker_error_peak", "worst": "R.Toe", "value": 6.23, "unit": "cm",
       "limit": 4, "fail_above": 8, "source": "OpenSim checklist",
       "fail_source": "gaitmill: twice the limit", "verdict": "warn",
       "meaning": "inverse kinematics misses a marker by",
       "explanation": "…", "cause": "R.Toe moves.", "fix": "Look at R.Toe."},
      {"stage": "cmc", "figure": "residual_moment_share", "worst": "MZ", "value": 0.5, "unit": "%",
       "limit": 1, "fail_above": null, "source": "Hicks et al. 2015", "verdict": "pass",
       "meaning": "the residual moment peaks at"}],
    "stages": {"ik": {"verdict": "warn", "checks": ["marker_error_rms", "marker_error_peak"],
                      "reasons": ["inverse kinematics misses a marker by 6.23 cm"]},
               "cmc": {"verdict": "pass", "checks": ["residual_moment_share"], "reasons": []}},
    "marker_errors": {"R.Toe": {"weight": 1, "mean_m": 0.01, "rms_m": 0.02, "max_m": 0.0623,
                                "max_frame": 17, "max_time_s": 0.17, "visible_percent": 100},
                      "RASI": {"weight": 50, "mean_m": 0.02, "rms_m": 0.03, "max_m": 0.0405,
                               "max_frame": 3, "max_time_s": 0.03, "visible_percent": 97}}},
  "warnings": ["ik: marker R.Toe is 6.2 cm from its measurement"]
})";

class ReportTest : public ::testing::Test {
 protected:
  std::string render(const std::string& summary = kSummary) {
    const MemoryResults results(summary);
    content_.results = &results;
    return renderReport(content_);
  }
  ReportContent content_;
};

std::size_t count(const std::string& page, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) {
    ++found;
  }
  return found;
}

TEST_F(ReportTest, SaysVerdictAndWhy) {
  const std::string page = render();
  EXPECT_NE(page.find("Usable with care: 1 figure of 3 exceed"), std::string::npos);
  EXPECT_NE(page.find("<a href=\"#ik\">Inverse kinematics</a>"), std::string::npos);
  EXPECT_EQ(count(page, "id=\"ik\""), 1U);
  EXPECT_EQ(count(page, "id=\"rra\""), 0U) << "a stage that did not run has no section";
}

TEST_F(ReportTest, ShowsEachCheckWithValueLimitAndSource) {
  const std::string page = render();
  EXPECT_NE(page.find("Inverse kinematics misses a marker by"), std::string::npos);
  EXPECT_NE(page.find("6.23\u00a0cm"), std::string::npos);
  EXPECT_NE(page.find(">4.00\u00a0cm</td>"), std::string::npos);
  EXPECT_NE(page.find(">never</td>"), std::string::npos);
  EXPECT_NE(page.find("Hicks et al. 2015"), std::string::npos);
}

TEST_F(ReportTest, TellsCauseAndFixBelowAWarningOnly) {
  const std::string page = render();
  EXPECT_EQ(count(page, "Likely cause:"), 1U);
  EXPECT_NE(page.find("<strong>What to do:</strong> Look at R.Toe."), std::string::npos);
}

TEST_F(ReportTest, ListsMarkersWorstFirst) {
  const std::string page = render();
  const std::size_t worse = page.find("<th scope=\"row\">RASI</th>");
  EXPECT_LT(worse, page.find("<th scope=\"row\">R.Toe</th>"));
  EXPECT_NE(page.find("<td class=\"number\">62.3</td><td class=\"number\">17</td>"),
            std::string::npos);
}

TEST_F(ReportTest, ComparesWithEmg) {
  const std::string page = render(R"({"emg": {"comparison": [
      {"channel": "GAS", "muscles": ["gasmed_r", "gaslat_r"], "side": "right", "overlap": 0.87,
       "onset_difference_percent": -3, "offset_difference_percent": null, "correlation": 0.91,
       "lag_percent": 4}]}})");
  EXPECT_NE(page.find("<th scope=\"row\">GAS</th><td>gasmed_r, gaslat_r</td><td>right</td>"
                      "<td class=\"number\">87.0</td><td class=\"number\">-3.00</td>"
                      "<td class=\"number\">\u2013</td>"),
            std::string::npos);
}

TEST_F(ReportTest, DrawsItsFiguresAndEscapesTheirWords) {
  Figure figure;
  figure.name = "moments";
  figure.title = "Moments <script>";
  figure.caption = "Of <b>joints</b>.";
  figure.panels.resize(1);
  figure.panels[0].title = "Knee <script>";
  figure.panels[0].series.resize(1);
  figure.panels[0].series[0].name = "<script>";
  figure.panels[0].series[0].x = {0, 1};
  figure.panels[0].series[0].y = {0, 1};
  content_.figures = {figure};
  const std::string page = render();
  EXPECT_EQ(count(page, "<svg"), 1U + count(page, "<svg x="));
  EXPECT_NE(page.find("<h3>Moments &lt;script&gt;</h3>"), std::string::npos);
  EXPECT_NE(page.find("<p>Of &lt;b&gt;joints&lt;/b&gt;.</p>"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST_F(ReportTest, NamesItsOriginWithHashes) {
  content_.provenance.provenance = "81c4";
  content_.provenance.version = "0.1.0 abc";
  content_.provenance.inputs = {{"markers", "walk1.trc", 1234, "e3b0c442"}};
  const std::string page = render();
  for (const char* fact : {"walk1.trc", "1234", "e3b0c442", "81c4", "0.1.0 abc", "1.76\u00a0m"}) {
    EXPECT_NE(page.find(fact), std::string::npos) << fact;
  }
}

TEST_F(ReportTest, CarriesItsPictures) {
  content_.images = {{"Right heel strike, 0.25 s", "image/png", "foo"}};
  const std::string page = render();
  EXPECT_NE(page.find("src=\"data:image/png;base64,Zm9v\""), std::string::npos);
  EXPECT_NE(page.find("alt=\"The model&#39;s pose at: Right heel strike, 0.25 s\""),
            std::string::npos);
}

// Whatever comes from outside: names of subjects, files, markers, settings, warnings.
TEST_F(ReportTest, LetsNothingFromOutsideBecomeMarkup) {
  const std::string evil = "<script>\"'&</script>";
  std::string summary = kSummary;
  for (std::size_t at = summary.find("R.Toe"); at != std::string::npos;
       at = summary.find("R.Toe", at)) {
    summary.replace(at, 5, "<script>'&</script>");
  }
  ReportProvenance& from = content_.provenance;
  for (std::string* field : {&from.job_id,
                             &from.created_at,
                             &from.finished_at,
                             &from.subject,
                             &from.label,
                             &from.model,
                             &from.settings_name,
                             &from.provenance,
                             &from.version}) {
    *field = evil;
  }
  from.inputs = {{evil, evil, 1, evil}};
  content_.images = {{evil, evil, "foo"}};
  const std::string page = render(summary);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("\"'"), std::string::npos);
  EXPECT_GT(count(page, "&lt;script&gt;"), 15U);
}

TEST_F(ReportTest, HasNothingToLoadAndNothingToRun) {
  const std::string page = render();
  for (const char* what :
       {"<script", "<link", "<iframe", "http://", "https://", "url(", "@import"}) {
    EXPECT_EQ(page.find(what), std::string::npos) << what;
  }
}

TEST_F(ReportTest, StandsWithoutAnyResult) {
  const std::string page = render("{}");
  EXPECT_EQ(page.find("<!DOCTYPE html>"), 0U);
  EXPECT_NE(page.find("nothing that could be judged"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
