#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/data/figure.h"
#include "core/figure/result_source.h"

namespace gaitmill {

/// An image of the report.
struct ReportImage {
  std::string caption;       ///< "Right heel strike, 0.25 s"
  std::string content_type;  ///< "image/png"
  std::string bytes;
};

/// One input file as it was uploaded.
struct ReportInput {
  std::string part;  ///< "markers"
  std::string name;  ///< "walk1.trc"
  std::int64_t size = 0;
  std::string sha256;  ///< hex
};

/// Where a report's numbers come from.
struct ReportProvenance {
  std::string job_id;
  std::string created_at;  ///< RFC 3339
  std::string finished_at;
  std::string subject;  ///< as the user named it; may be empty
  std::string label;
  std::string model;          ///< name of the generic model
  std::string settings_name;  ///< of the settings document; the document itself is in the summary
  std::string provenance;     ///< hash over inputs, model, settings and code, hex
  std::string version;        ///< of gaitmill, with the hash of its sources
  std::vector<ReportInput> inputs;
};

struct ReportContent {
  ReportProvenance provenance;
  const ResultSource* results = nullptr;  ///< summary and tables
  std::vector<Figure> figures;            ///< in the order they are shown
  std::vector<ReportImage> images;        ///< heel strike, mid-stance, toe-off, mid-swing
};

/// One self-contained HTML file: inline SVG and images, no script, prints well. Everything from
/// outside is escaped.
std::string renderReport(const ReportContent& content);

/// The instants that the report shows: right heel strike, mid-stance, toe-off, mid-swing.
struct ReportInstant {
  std::string name;
  double time = 0;  ///< [s]
};
std::vector<ReportInstant> findReportInstants(const ResultSource& results);

}  // namespace gaitmill
