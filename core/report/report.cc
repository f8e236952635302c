#include "core/report/report.h"

#include <string>

#include "core/base/error.h"
#include "core/report/report_parts.h"

namespace gaitmill {

namespace {

constexpr const char* kStages[] = {"scale", "ik", "rra", "id", "so", "cmc"};

Html renderHead(const ReportProvenance& provenance) {
  const std::string of = provenance.subject.empty() ? provenance.job_id : provenance.subject;
  // Nothing is loaded and nothing runs, whatever slips through.
  const char* const policy =
      "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
      "form-action 'none'";
  return element(
      "head",
      voidElement("meta", {{"charset", "utf-8"}}) +
          voidElement("meta", {{"http-equiv", "Content-Security-Policy"}, {"content", policy}}) +
          voidElement("meta",
                      {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}) +
          element("title", "Gait report: " + of) + element("style", trusted(reportStyle())));
}

Html renderStages(const Json& summary) {
  Html stages;
  for (const char* const stage : kStages) {
    stages += renderStage(stage, summary);
  }
  return stages;
}

}  // namespace

std::string renderReport(const ReportContent& content) {
  check(content.results != nullptr, "a report has results");
  const Json summary = Json::parse(content.results->summary());
  const ReportProvenance& provenance = content.provenance;
  const Html body =
      renderHeader(provenance, summary) +
      element("main",
              renderOverview(summary) + renderPoses(content.images) + renderStages(summary) +
                  renderEmg(summary) + renderFigures(content.figures) + renderWarnings(summary) +
                  renderProvenance(provenance, summary)) +
      renderFooter(provenance);
  return "<!DOCTYPE html>\n" +
         element("html", {{"lang", "en"}}, renderHead(provenance) + element("body", body))
             .markup() +
         "\n";
}

}  // namespace gaitmill
