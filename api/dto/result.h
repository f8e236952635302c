#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/http.h"
#include "core/data/time_series.h"

namespace gaitmill::api {

enum class TableAxis { kTime, kCycle };
enum class AngleUnit { kRadians, kDegrees };
enum class ResultFormat { kJson, kCsv, kSto, kVegaLite, kSvg };

/// Names of all result tables, as in PipelineResult::tables.
const std::vector<std::string>& tableNames();

/// One result that a job has so far.
struct ResultView {
  std::string name;        ///< of tableNames(), or "quality"
  std::string stage;       ///< that made it
  bool has_cycle = false;  ///< also on the cycle axis
};

/// A table with what it comes from.
struct ResultTable {
  TimeSeries table;
  std::string stage;       ///< that made it
  std::string provenance;  ///< of the job, hex
  std::string settings_json;
  bool is_final = false;  ///< false while a later stage may still replace it
};

struct FileView {
  std::string name;
  std::int64_t size = 0;  ///< [bytes]
  std::string sha256;     ///< hex
};

struct FileContent {
  FileView view;
  std::shared_ptr<const ByteSource> bytes;
};

using Formats = std::vector<ResultFormat>;

/// One of `offers`, by the parameter `format` ("" if absent), else the one that the Accept header
/// likes best ("" = the first).
/// @throws Error kRequestNotAcceptable naming what there is
ResultFormat findResultFormat(const std::string& format,
                              const std::string& accept,
                              const Formats& offers);

/// @throws Error kRequestField; "" means time, radians
TableAxis parseTableAxis(const std::string& text);
AngleUnit parseAngleUnit(const std::string& text);

/// "application/json", "text/csv; charset=utf-8", "application/vnd.opensim.sto",
/// "application/vnd.vegalite.v5+json", "image/svg+xml"
const char* contentType(ResultFormat format);
/// "json", "csv", "sto", "vega-lite", "svg"
const char* formatName(ResultFormat format);

/// Columns in rad and rad/s to deg and deg/s; all others as they are.
TimeSeries convertToDegrees(TimeSeries table);

/// {"name", "stage", "final", "provenance", "axis": {"name", "unit", "values"}, "columns":
/// [{"name", "unit", "side", "values"}], "settings"}, NaN as null. Numbers have the digits that
/// give the same double back; the side is "right", "left" or null.
std::string renderTableJson(const ResultTable& result, TableAxis axis);

/// First row "time [s],hip_flexion_r [N.m],…"; dimensionless columns have the unit 1; NaN is an
/// empty cell.
std::string renderTableCsv(const TimeSeries& table, TableAxis axis);

using Quantities = std::vector<std::pair<std::string, double>>;

/// Every number of the quality figures with its dotted path.
Quantities listQuantities(const std::string& quality_json);

/// "quantity,value" with one row per number, quantities as dotted paths whose last part wears the
/// unit: "moments.ankle_angle_r.rmse_nm,0.31".
std::string renderQualityCsv(const std::string& quality_json);

/// The same numbers as a table of one row at time 0.
TimeSeries makeQualityTable(const std::string& quality_json);

std::string renderFile(const FileView& file);
std::string renderResult(const ResultView& result);

}  // namespace gaitmill::api
