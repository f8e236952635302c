// Figures as data: of a job, of jobs held against each other, of a model.

#include <algorithm>
#include <charconv>
#include <sstream>
#include <system_error>
#include <utility>

#include "api/dto/figure.h"
#include "api/dto/result.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kMaxCompared = 8;  // jobs: more curves than colours tell apart

const std::string& jobId(const HttpRequest& request) {
  return idOf(request, "job_", ErrorCode::kJobNotFound);
}

/// How a figure is wanted.
struct WantedForm {
  ResultFormat format = ResultFormat::kJson;
  bool only_data = false;

  FigureForm form() const {
    return only_data                      ? FigureForm::kData
           : format == ResultFormat::kSvg ? FigureForm::kSvg
                                          : FigureForm::kVegaLite;
  }
};

WantedForm readForm(const HttpRequest& request) {
  WantedForm form;
  form.format =
      findResultFormat(queryOf(request, "format"),
                       request.header("accept"),
                       {ResultFormat::kJson, ResultFormat::kVegaLite, ResultFormat::kSvg});
  const std::string data = queryOf(request, "data");
  require(data.empty() || data == "only",
          ErrorCode::kRequestField,
          "parameter 'data' is 'only' or left out",
          {"", 0, 0, "data"});
  form.only_data = data == "only";
  require(!form.only_data || form.format == ResultFormat::kJson,
          ErrorCode::kRequestNotAcceptable,
          "data alone comes as json",
          {"", 0, 0, "data"});
  return form;
}

// @param tag  of what the figure is made from
template <class Find>
HttpReply replyFigure(FigurePort& figures,
                      const HttpRequest& request,
                      const std::string& tag,
                      Find find) {
  const WantedForm form = readForm(request);
  const std::string whole = "\"" + tag + "-" + request.captures.at("name") + "-" +
                            (form.only_data ? "data" : formatName(form.format)) + "\"";
  HttpReply reply = replyUnlessKnown(request, whole, [&] {
    HttpReply made;
    made.content_type = contentType(form.format);
    made.body = figures.encode(find(), form.form());
    return made;
  });
  reply.headers["Vary"] = "Accept";
  return reply;
}

HttpReply listFigures(FigurePort& figures, HttpRequest& request) {
  const std::string& id = jobId(request);
  return replyTagged(
      renderFigureList(figures.list(request.identity, id), "/v1/jobs/" + id + "/plots"));
}

HttpReply findFigure(FigurePort& figures, HttpRequest& request) {
  const std::string& id = jobId(request);
  return replyFigure(figures, request, figures.findTag(request.identity, id), [&] {
    return figures.find(request.identity, id, request.captures.at("name"));
  });
}

// The parameter jobs=job_…,job_…
Names readJobs(const HttpRequest& request) {
  Names ids;
  std::istringstream list(queryOf(request, "jobs"));
  for (std::string id; std::getline(list, id, ',');) {
    require(isId(id, "job_"),
            ErrorCode::kRequestField,
            "parameter 'jobs' is a list of job ids such as job_...,job_...",
            {"", 0, 0, "jobs"});
    require(std::find(ids.begin(), ids.end(), id) == ids.end(),
            ErrorCode::kRequestField,
            "parameter 'jobs' names " + id + " twice",
            {"", 0, 0, "jobs"});
    ids.push_back(id);
  }
  require(ids.size() >= 2 && ids.size() <= kMaxCompared,
          ErrorCode::kRequestField,
          "parameter 'jobs' takes 2 to 8 job ids with commas between them",
          {"", 0, 0, "jobs"});
  return ids;
}

HttpReply compareJobs(ComparePort& comparisons, HttpRequest& request) {
  const Names ids = readJobs(request);
  const ComparisonView found = comparisons.compare(request.identity, ids);
  return replyTagged(renderComparisonPage(ids, found.comparison, found.figures));
}

HttpReply findOverlay(const Ports& ports, HttpRequest& request) {
  const Names ids = readJobs(request);
  ComparePort& comparisons = ports.comparisons;
  return replyFigure(ports.figures, request, comparisons.findTag(request.identity, ids), [&] {
    return comparisons.find(request.identity, ids, request.captures.at("name"));
  });
}

std::uint64_t readSeed(const HttpRequest& request) {
  std::uint64_t seed = 1;
  const auto found = request.query.find("seed");
  if (found != request.query.end()) {
    const std::string& text = found->second;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, seed);
    require(parsed.ec == std::errc() && parsed.ptr == end,
            ErrorCode::kRequestField,
            "parameter 'seed' must be a whole number from 0 to 18446744073709551615",
            {"", 0, 0, "seed"});
  }
  return seed;
}

HttpReply listValidations(ValidationPort& validations, HttpRequest& request) {
  const std::string& id = request.captures.at("id");
  return replyTagged(
      renderFigureList(validations.list(request.identity, id), "/v1/models/" + id + "/validation"));
}

HttpReply findValidation(const Ports& ports, HttpRequest& request) {
  ValidationPort& validations = ports.validations;
  const std::string& id = request.captures.at("id");
  const std::uint64_t seed = readSeed(request);
  return replyFigure(ports.figures, request, validations.findTag(request.identity, id, seed), [&] {
    return validations.find(request.identity, id, request.captures.at("name"), seed);
  });
}

}  // namespace

Routes makeFigureRoutes(const Ports& ports) {
  const auto get = [](const std::string& pattern, Handler handler, bool is_slow = false) {
    return Route{"GET", pattern, BodyKind::kNone, std::move(handler), Scope::kRead, 0, is_slow};
  };
  const std::string plots = "/v1/jobs/{id}/plots";
  const std::string validation = "/v1/models/{id}/validation";
  return {
      get(plots, on(ports.figures, listFigures)),
      get(plots + "/{name}", on(ports.figures, findFigure, {"format", "data"})),
      get("/v1/compare", on(ports.comparisons, compareJobs, {"jobs"}), true),
      get("/v1/compare/plots/{name}",
          withQuery({"jobs", "format", "data"},
                    [ports](HttpRequest& request) { return findOverlay(ports, request); }),
          true),
      get(validation, on(ports.validations, listValidations), true),
      get(validation + "/{name}",
          withQuery({"seed", "format", "data"},
                    [ports](HttpRequest& request) { return findValidation(ports, request); }),
          true),
  };
}

}  // namespace gaitmill::api
