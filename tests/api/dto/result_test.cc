#include "api/dto/result.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

TimeSeries makeTable() {
  TimeSeries table = makeTimeSeries("forces", {"a", "odd, \"label\""}, {0.1, 0.30000000000000004});
  table.units = {"N", ""};
  table.values << 1.0 / 3.0, -1e-300, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity();
  return table;
}

ResultTable makeResult(const TimeSeries& table) {
  return {table, "so", "ab", R"({"so":{}})", true};
}

TEST(RenderTableJson, KeepsEveryDigitAndWritesNullForMissing) {
  const auto json =
      nlohmann::json::parse(renderTableJson(makeResult(makeTable()), TableAxis::kTime));
  EXPECT_EQ(json["name"], "forces");
  EXPECT_EQ(json["axis"]["name"], "time");
  EXPECT_EQ(json["axis"]["unit"], "s");
  EXPECT_EQ(json["axis"]["values"][1], 0.30000000000000004);
  EXPECT_EQ(json["columns"][0]["values"], nlohmann::json({1.0 / 3.0, nullptr}));
  EXPECT_EQ(json["columns"][1]["unit"], "1");
  EXPECT_EQ(json["columns"][1]["values"], nlohmann::json({-1e-300, nullptr}));
}

TEST(RenderTableJson, TellsTheSideByTheName) {
  const TimeSeries table = makeTimeSeries("t",
                                          {"soleus_r",
                                           "hip_flexion_l_moment",
                                           "hip_r_on_femur_r_in_femur_r_fx",
                                           "pelvis_tilt",
                                           "lumbar",
                                           "r"},
                                          {});
  const auto json = nlohmann::json::parse(renderTableJson(makeResult(table), TableAxis::kTime));
  const nlohmann::json sides = {"right", "left", "right", nullptr, nullptr, "right"};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    EXPECT_EQ(json["columns"][i]["side"], sides[i]) << json["columns"][i]["name"];
  }
}

TEST(RenderTableCsv, QuotesLabelsAndLeavesMissingCellsEmpty) {
  EXPECT_EQ(renderTableCsv(makeTable(), TableAxis::kCycle),
            "gait_cycle [percent],a [N],\"odd, \"\"label\"\" [1]\"\n"
            "0.1,0.3333333333333333,-1e-300\n0.30000000000000004,,\n");
}

TEST(RenderTable, TakesTablesWithoutRowsAndUnits) {
  const TimeSeries empty = makeTimeSeries("none", {"a"}, {});
  EXPECT_EQ(renderTableCsv(empty, TableAxis::kTime), "time [s],a [1]\n");
  const auto json = nlohmann::json::parse(renderTableJson(makeResult(empty), TableAxis::kTime));
  EXPECT_TRUE(json["columns"][0]["values"].empty());
}

const Formats kAll = {ResultFormat::kJson, ResultFormat::kCsv, ResultFormat::kSto};

struct AcceptRow {
  const char* format;
  const char* accept;
  ResultFormat expected;
};
class Negotiation : public ::testing::TestWithParam<AcceptRow> {};
TEST_P(Negotiation, FindsTheFormat) {
  EXPECT_EQ(findResultFormat(GetParam().format, GetParam().accept, kAll), GetParam().expected);
}
INSTANTIATE_TEST_SUITE_P(
    Table,
    Negotiation,
    ::testing::Values(AcceptRow{"", "", ResultFormat::kJson},
                      AcceptRow{"", "*/*", ResultFormat::kJson},
                      AcceptRow{"", "text/*", ResultFormat::kCsv},
                      AcceptRow{"", "text/html, text/csv;q=0.9", ResultFormat::kCsv},
                      AcceptRow{"", "image/png,application/json", ResultFormat::kJson},
                      AcceptRow{"", "application/vnd.opensim.sto", ResultFormat::kSto},
                      AcceptRow{"", "application/json;q=0.2, text/csv;q=0.9", ResultFormat::kCsv},
                      AcceptRow{"", "text/csv; q=0, */*; q=0.1", ResultFormat::kJson},
                      AcceptRow{"csv", "application/json", ResultFormat::kCsv},
                      AcceptRow{"json", "image/png", ResultFormat::kJson}));

TEST(FindResultFormat, RefusesWhatThereIsNot) {
  for (const char* accept :
       {"image/png", "text/csvx", ";", ",,", "application/json2", "text/csv;q=0", "*/*;q=x"}) {
    EXPECT_THROW(findResultFormat("", accept, kAll), Error) << accept;
  }
  EXPECT_THROW(findResultFormat("CSV", "", kAll), Error);
}

TEST(FindResultFormat, OffersOnlyWhatThereIs) {
  const Formats two = {ResultFormat::kJson, ResultFormat::kCsv};
  EXPECT_THROW(findResultFormat("sto", "", two), Error);
  EXPECT_EQ(findResultFormat("", "application/vnd.opensim.sto, text/*", two), ResultFormat::kCsv);
}

// Two jobs may have different lists of checks: the third of one is not the third of the other.
TEST(Quality, ChecksGoByTheirFigureAndUnit) {
  const std::string json = R"({"checks": [
      {"figure": "residual_moment_peak", "unit": "N.m", "value": 4.5, "limit": 75},
      {"figure": "reserves", "unit": "%", "value": 2}]})";
  EXPECT_EQ(renderQualityCsv(json),
            "quantity,value\nchecks.residual_moment_peak.limit_nm,75\n"
            "checks.residual_moment_peak.value_nm,4.5\nchecks.reserves.value_percent,2\n");
}

TEST(Quality, IsFlattenedToPathsThatWearTheirUnits) {
  const std::string json = R"({"a": {"rmse_nm": 0.5, "name": "x", "ok": true}, "b_deg": [1, 2]})";
  EXPECT_EQ(renderQualityCsv(json), "quantity,value\na.rmse_nm,0.5\nb_deg.0,1\nb_deg.1,2\n");
  const TimeSeries table = makeQualityTable(json);
  EXPECT_EQ(table.labels, (std::vector<std::string>{"a.rmse_nm", "b_deg.0", "b_deg.1"}));
  EXPECT_EQ(table.values(0, 2), 2.0);
}

}  // namespace
}  // namespace gaitmill::api
