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

TEST(RenderTableJson, KeepsEveryDigitAndWritesNullForMissing) {
  const auto json = nlohmann::json::parse(renderTableJson(makeTable(), TableAxis::kTime));
  EXPECT_EQ(json["name"], "forces");
  EXPECT_EQ(json["axis"]["name"], "time");
  EXPECT_EQ(json["axis"]["unit"], "s");
  EXPECT_EQ(json["axis"]["values"][1], 0.30000000000000004);
  EXPECT_EQ(json["columns"][0]["values"], nlohmann::json({1.0 / 3.0, nullptr}));
  EXPECT_EQ(json["columns"][1]["unit"], "1");
  EXPECT_EQ(json["columns"][1]["values"], nlohmann::json({-1e-300, nullptr}));
}

TEST(RenderTableCsv, QuotesLabelsAndLeavesMissingCellsEmpty) {
  EXPECT_EQ(renderTableCsv(makeTable(), TableAxis::kCycle),
            "gait_cycle [percent],a [N],\"odd, \"\"label\"\" [1]\"\n"
            "0.1,0.3333333333333333,-1e-300\n0.30000000000000004,,\n");
}

TEST(RenderTable, TakesTablesWithoutRowsAndUnits) {
  const TimeSeries empty = makeTimeSeries("none", {"a"}, {});
  EXPECT_EQ(renderTableCsv(empty, TableAxis::kTime), "time [s],a [1]\n");
  const auto json = nlohmann::json::parse(renderTableJson(empty, TableAxis::kTime));
  EXPECT_TRUE(json["columns"][0]["values"].empty());
}

struct AcceptRow {
  const char* format;
  const char* accept;
  ResultFormat expected;
};
class Negotiation : public ::testing::TestWithParam<AcceptRow> {};
TEST_P(Negotiation, FindsTheFormat) {
  EXPECT_EQ(findResultFormat(GetParam().format, GetParam().accept), GetParam().expected);
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
                      AcceptRow{"csv", "application/json", ResultFormat::kCsv},
                      AcceptRow{"json", "image/png", ResultFormat::kJson}));

TEST(FindResultFormat, RefusesWhatThereIsNot) {
  for (const char* accept : {"image/png", "text/csvx", ";", ",,", "application/json2"}) {
    EXPECT_THROW(findResultFormat("", accept), Error) << accept;
  }
  EXPECT_THROW(findResultFormat("CSV", ""), Error);
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
