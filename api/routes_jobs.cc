// Jobs: what is computed from a trial.

#include <chrono>
#include <optional>

#include "api/digest.h"
#include "api/dto/job.h"
#include "api/event_stream.h"
#include "api/idempotency.h"
#include "api/prefer.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

const std::string& jobId(const HttpRequest& request) {
  return idOf(request, "job_", ErrorCode::kJobNotFound);
}

// Weak, because the estimated time left moves without a new version.
HttpReply replyJob(const JobView& job) {
  HttpReply reply = replyJson(200, renderJob(job));
  reply.headers["ETag"] = "W/\"" + std::to_string(job.version) + "-" +
                          std::to_string(job.jobs_ahead.value_or(0)) + "\"";
  return reply;
}

HttpReply submitJob(JobPort& jobs, HttpRequest& request) {
  checkContentDigest(request);
  JobRequest wanted = parseJobRequest(bodyText(request));
  wanted.submission_key = request.header("idempotency-key");
  const JobView job = jobs.submit(request.identity, wanted);
  return replyCreated(202, "/v1/jobs/" + job.id, renderJob(job));
}

HttpReply listJobs(JobPort& jobs, HttpRequest& request) {
  const ListFilter filter = readFilter(request);
  return replyPage(jobs.list(request.identity, filter, readPage(request, "job_")), renderJob);
}

HttpReply findJob(JobPort& jobs, HttpRequest& request) {
  const std::string& id = jobId(request);
  const std::optional<std::chrono::seconds> wait = findWait(request);
  const JobView job = jobs.find(request.identity, id);
  if (wait && !isFinal(job.state) && !request.wait_is_over) {
    return parkFor(id, *wait);
  }
  HttpReply reply = replyJob(job);
  if (wait) {
    noteWait(*wait, reply);
  }
  return reply;
}

HttpReply cancelJob(JobPort& jobs, HttpRequest& request) {
  return replyJson(202, renderJob(jobs.cancel(request.identity, jobId(request))));
}

HttpReply removeJob(JobPort& jobs, HttpRequest& request) {
  jobs.remove(request.identity, jobId(request));
  return replyNothing();
}

HttpReply watchJob(JobPort& jobs, HttpRequest& request) {
  const std::int64_t after = findLastEventId(request);
  HttpReply reply;
  reply.content_type = "text/event-stream";
  reply.headers["Cache-Control"] = "no-store";
  reply.events = makeJobFeed(jobs, request.identity, jobId(request), after);
  return reply;
}

}  // namespace

Routes makeJobRoutes(const Ports& ports) {
  JobPort& jobs = ports.jobs;
  const Handler submit = withWait(jobs, withIdempotency(ports.idempotency, on(jobs, submitJob)));
  const Handler list = on(jobs,
                          listJobs,
                          {"limit",
                           "cursor",
                           "state",
                           "subject",
                           "label",
                           "trial",
                           "study",
                           "created_after",
                           "created_before"});
  const Handler watch = on(jobs, watchJob, {"last_event_id"});
  return {
      {"POST", "/v1/jobs", BodyKind::kJson, submit, Scope::kWrite},
      {"GET", "/v1/jobs", BodyKind::kNone, list, Scope::kRead},
      {"GET", "/v1/jobs/{id}", BodyKind::kNone, on(jobs, findJob), Scope::kRead},
      {"DELETE", "/v1/jobs/{id}", BodyKind::kNone, on(jobs, removeJob), Scope::kWrite},
      {"POST", "/v1/jobs/{id}/cancel", BodyKind::kNone, on(jobs, cancelJob), Scope::kWrite},
      {"GET", "/v1/jobs/{id}/events", BodyKind::kNone, watch, Scope::kRead},
  };
}

}  // namespace gaitmill::api
