// Results: what came out of a job.

#include <algorithm>
#include <utility>

#include "api/dto/result.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

const std::string& jobId(const HttpRequest& request) {
  return idOf(request, "job_", ErrorCode::kJobNotFound);
}

void requireResultName(const std::string& name) {
  const Names& tables = tableNames();
  if (name == "quality" || std::find(tables.begin(), tables.end(), name) != tables.end()) {
    return;
  }
  std::string list = "quality";
  for (const std::string& table : tables) {
    list += ", " + table;
  }
  const std::string nearest = findNearestName(name, tables);
  throw Error(ErrorCode::kResultNotFound,
              "results are " + list + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"),
              {"", 0, 0, name});
}

// Equal for equal inputs, model, settings and code; other representations have other tags.
std::string makeTag(const std::string& provenance, const Names& representation) {
  std::string tag = "\"" + provenance;
  for (const std::string& word : representation) {
    tag += "-" + word;
  }
  return tag + "\"";
}

HttpReply replyResult(ResultFormat format, std::string body, const std::string& tag) {
  HttpReply reply;
  reply.content_type = contentType(format);
  reply.headers["Vary"] = "Accept";
  reply.headers["ETag"] = tag;
  reply.body = std::move(body);
  return reply;
}

HttpReply findQuality(const Ports& ports, const HttpRequest& request, ResultFormat format) {
  const std::string quality = ports.results.findQuality(request.identity, jobId(request));
  const JobView job = ports.jobs.find(request.identity, jobId(request));
  const std::string tag = makeTag(job.provenance, {"quality", formatName(format)});
  if (format == ResultFormat::kCsv) {
    return replyResult(format, renderQualityCsv(quality), tag);
  }
  if (format == ResultFormat::kSto) {
    return replyResult(
        format, ports.results.encodeSto(makeQualityTable(quality), AngleUnit::kRadians), tag);
  }
  return replyResult(format, quality, tag);
}

std::string encodeTable(ResultPort& results,
                        ResultTable& result,
                        TableAxis axis,
                        AngleUnit angles,
                        ResultFormat format) {
  if (format == ResultFormat::kSto) {
    // Storage files call their first column time, whatever it holds.
    result.table.name +=
        axis == TableAxis::kCycle ? ", column time in percent of the gait cycle" : "";
    return results.encodeSto(result.table, angles);
  }
  if (angles == AngleUnit::kDegrees) {
    result.table = convertToDegrees(std::move(result.table));
  }
  return format == ResultFormat::kCsv ? renderTableCsv(result.table, axis)
                                      : renderTableJson(result, axis);
}

HttpReply findTable(ResultPort& results, const HttpRequest& request, ResultFormat format) {
  const std::string& name = request.captures.at("name");
  const TableAxis axis = parseTableAxis(queryOf(request, "axis"));
  const AngleUnit angles = parseAngleUnit(queryOf(request, "angles"));
  ResultTable result = results.findTable(request.identity, jobId(request), name, axis);
  const std::string tag = makeTag(result.provenance,
                                  {name,
                                   result.stage,
                                   result.is_final ? "final" : "partial",
                                   axis == TableAxis::kCycle ? "cycle" : "time",
                                   angles == AngleUnit::kDegrees ? "deg" : "rad",
                                   formatName(format)});
  return replyResult(format, encodeTable(results, result, axis, angles, format), tag);
}

HttpReply findResult(const Ports& ports, HttpRequest& request) {
  const std::string& name = request.captures.at("name");
  requireResultName(name);
  const ResultFormat format =
      findResultFormat(queryOf(request, "format"),
                       request.header("accept"),
                       {ResultFormat::kJson, ResultFormat::kCsv, ResultFormat::kSto});
  return name == "quality" ? findQuality(ports, request, format)
                           : findTable(ports.results, request, format);
}

HttpReply listResults(ResultPort& results, HttpRequest& request) {
  return replyPage(Page<ResultView>{results.list(request.identity, jobId(request)), ""},
                   renderResult);
}

HttpReply listFiles(ResultPort& results, HttpRequest& request) {
  return replyPage(Page<FileView>{results.listFiles(request.identity, jobId(request)), ""},
                   renderFile);
}

HttpReply findFile(ResultPort& results, HttpRequest& request) {
  return replyFile(results.findFile(request.identity, jobId(request), request.captures.at("name")),
                   "application/octet-stream");
}

HttpReply findArchive(ResultPort& results, HttpRequest& request) {
  return replyFile(results.makeArchive(request.identity, jobId(request)), "application/zip");
}

}  // namespace

Routes makeResultRoutes(const Ports& ports) {
  ResultPort& results = ports.results;
  const Handler find = withQuery({"format", "axis", "angles"}, [ports](HttpRequest& request) {
    return findResult(ports, request);
  });
  const std::string job = "/v1/jobs/{id}";
  return {
      {"GET", job + "/results", BodyKind::kNone, on(results, listResults), Scope::kRead},
      {"GET", job + "/results/{name}", BodyKind::kNone, find, Scope::kRead},
      {"GET",
       job + "/results.zip",
       BodyKind::kNone,
       on(results, findArchive),
       Scope::kRead,
       0,
       true},
      {"GET", job + "/files", BodyKind::kNone, on(results, listFiles), Scope::kRead},
      {"GET", job + "/files/{name}", BodyKind::kNone, on(results, findFile), Scope::kRead},
  };
}

}  // namespace gaitmill::api
