#include "api/routes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "api/dto/job.h"
#include "api/dto/result.h"
#include "api/dto/trial.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

std::string queryOf(const HttpRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

HttpReply reply(int status, std::string json) {
  HttpReply answer;
  answer.status = status;
  answer.body = std::move(json);
  return answer;
}

HttpReply replyWithLocation(int status, const std::string& location, std::string json) {
  HttpReply answer = reply(status, std::move(json));
  answer.headers["Location"] = location;
  return answer;
}

// "C:\lab\walk1.trc" and "../../walk1.trc" are "walk1.trc": the name is a label in messages. A file
// without a name is called as its part.
std::string makeLabel(const BodyPart& part) {
  const std::string& name = part.file_name;
  const std::size_t slash = name.find_last_of("/\\");
  const std::string base = slash == std::string::npos ? name : name.substr(slash + 1);
  std::string label;
  std::copy_if(base.begin(), base.end(), std::back_inserter(label), [](unsigned char letter) {
    return letter >= 0x20 && letter != 0x7f;
  });
  return label.empty() ? part.name : label.substr(0, 200);
}

TrialUpload readUpload(HttpRequest& request) {
  TrialUpload upload;
  bool has_subject = false;
  for (BodyPart& part : request.parts) {
    if (part.name == "trial") {
      require(!std::exchange(has_subject, true),
              ErrorCode::kRequestField,
              "part 'trial' is there twice",
              {"", 0, 0, "trial"});
      upload.subject = parseTrialSubject(part.bytes);
      continue;
    }
    const auto& known = trialParts();
    require(std::find(known.begin(), known.end(), part.name) != known.end(),
            ErrorCode::kRequestField,
            "there is no part of this name; parts are trial, markers, grf, static, static2, emg, "
            "model and coordinates",
            {"", 0, 0, part.name.substr(0, 100)});
    const bool is_new =
        upload.files.emplace(part.name, UploadedFile{makeLabel(part), std::move(part.bytes)})
            .second;
    require(is_new,
            ErrorCode::kRequestField,
            "part '" + part.name + "' is there twice",
            {"", 0, 0, part.name});
  }
  require(has_subject,
          ErrorCode::kRequestField,
          "part 'trial' with mass_kg and height_m is missing",
          {"", 0, 0, "trial"});
  return upload;
}

HttpReply submitTrial(TrialPort& trials, HttpRequest& request) {
  const TrialView trial = trials.submit(readUpload(request));
  return replyWithLocation(201, "/v1/trials/" + trial.id, renderTrial(trial));
}

HttpReply submitJob(JobPort& jobs, const HttpRequest& request) {
  const JobView job = jobs.submit(parseJobRequest(request.body));
  return replyWithLocation(202, "/v1/jobs/" + job.id, renderJob(job));
}

std::string encodeQuality(ResultPort& results, const std::string& quality, ResultFormat format) {
  switch (format) {
    case ResultFormat::kJson:
      return quality;
    case ResultFormat::kCsv:
      return renderQualityCsv(quality);
    case ResultFormat::kSto:
      return results.encodeSto(makeQualityTable(quality), AngleUnit::kRadians);
  }
  return "";
}

std::string encodeTable(ResultPort& results, const HttpRequest& request, ResultFormat format) {
  const TableAxis axis = parseTableAxis(queryOf(request, "axis"));
  const AngleUnit angles = parseAngleUnit(queryOf(request, "angles"));
  TimeSeries table =
      results.findTable(request.captures.at("id"), request.captures.at("name"), axis);
  if (format == ResultFormat::kSto) {
    // Storage files call their first column time, whatever it holds.
    table.name += axis == TableAxis::kCycle ? ", column time in percent of the gait cycle" : "";
    return results.encodeSto(table, angles);
  }
  if (angles == AngleUnit::kDegrees) {
    table = convertToDegrees(std::move(table));
  }
  return format == ResultFormat::kCsv ? renderTableCsv(table, axis) : renderTableJson(table, axis);
}

HttpReply findResult(ResultPort& results, const HttpRequest& request) {
  const std::string& name = request.captures.at("name");
  const auto& tables = tableNames();
  require(name == "quality" || std::find(tables.begin(), tables.end(), name) != tables.end(),
          ErrorCode::kResultNotFound,
          "results are moments, activations, forces, kinematics, residuals and quality",
          {"", 0, 0, name});
  const ResultFormat format = findResultFormat(queryOf(request, "format"), request.accept);
  HttpReply answer;
  answer.content_type = contentType(format);
  answer.headers["Vary"] = "Accept";
  answer.body = name == "quality"
                    ? encodeQuality(results, results.findQuality(request.captures.at("id")), format)
                    : encodeTable(results, request, format);
  return answer;
}

HttpReply findFile(ResultPort& results, const HttpRequest& request) {
  FileContent file = results.findFile(request.captures.at("id"), request.captures.at("name"));
  HttpReply answer;
  answer.content_type = "application/octet-stream";
  answer.headers["Content-Disposition"] = "attachment; filename=\"" + file.view.name + "\"";
  answer.headers["ETag"] = "\"" + file.view.sha256 + "\"";
  answer.body = std::move(file.bytes);
  return answer;
}

using Request = HttpRequest;
using Routes = std::vector<Route>;

Routes makeServiceRoutes(const std::string& version) {
  return {
      {"GET",
       "/healthz",
       BodyKind::kNone,
       [](Request&) {
         return reply(200, R"({"ok":true})");
       }},
      {"GET",
       "/v1/version",
       BodyKind::kNone,
       [version](Request&) {
         return reply(200, R"({"name":"gaitmill","version":")" + version + "\"}");
       }},
  };
}

Routes makeTrialRoutes(TrialPort& trials) {
  return {
      {"POST",
       "/v1/trials",
       BodyKind::kMultipart,
       [&trials](Request& request) {
         return submitTrial(trials, request);
       }},
      {"GET",
       "/v1/trials/{id}",
       BodyKind::kNone,
       [&trials](Request& request) {
         return reply(200, renderTrial(trials.find(request.captures.at("id"))));
       }},
  };
}

Routes makeJobRoutes(JobPort& jobs) {
  return {
      {"POST",
       "/v1/jobs",
       BodyKind::kJson,
       [&jobs](Request& request) {
         return submitJob(jobs, request);
       }},
      {"GET",
       "/v1/jobs/{id}",
       BodyKind::kNone,
       [&jobs](Request& request) {
         return reply(200, renderJob(jobs.find(request.captures.at("id"))));
       }},
      {"POST",
       "/v1/jobs/{id}/cancel",
       BodyKind::kNone,
       [&jobs](Request& request) {
         return reply(202, renderJob(jobs.cancel(request.captures.at("id"))));
       }},
  };
}

Routes makeResultRoutes(ResultPort& results) {
  return {
      {"GET",
       "/v1/jobs/{id}/results/{name}",
       BodyKind::kNone,
       [&results](Request& request) {
         return findResult(results, request);
       }},
      {"GET",
       "/v1/jobs/{id}/files",
       BodyKind::kNone,
       [&results](Request& request) {
         return reply(200, renderFiles(results.listFiles(request.captures.at("id"))));
       }},
      {"GET",
       "/v1/jobs/{id}/files/{name}",
       BodyKind::kNone,
       [&results](Request& request) {
         return findFile(results, request);
       }},
  };
}

}  // namespace

std::vector<Route> makeRoutes(Ports ports, const std::string& version) {
  Routes all = makeServiceRoutes(version);
  for (const Routes& group : {makeTrialRoutes(ports.trials),
                              makeJobRoutes(ports.jobs),
                              makeResultRoutes(ports.results)}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace gaitmill::api
