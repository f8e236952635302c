#include "api/prefer.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "api/dto/job.h"

namespace gaitmill::api {

namespace {

constexpr int kMaxWait = 300;  // [s]

// Where a parked submission notes its job: not a name that a path could capture.
constexpr const char* kSubmittedJob = "submitted job";

}  // namespace

std::optional<std::chrono::seconds> findWait(const HttpRequest& request) {
  std::istringstream preferences(request.header("prefer"));
  std::string preference;
  while (std::getline(preferences, preference, ',')) {
    const std::size_t begin = preference.find_first_not_of(" \t");
    if (begin == std::string::npos || preference.compare(begin, 5, "wait=") != 0) {
      continue;
    }
    int seconds = 0;
    const char* const end = preference.data() + preference.find_last_not_of(" \t") + 1;
    const auto parsed = std::from_chars(preference.data() + begin + 5, end, seconds);
    if (parsed.ec == std::errc() && parsed.ptr == end && seconds >= 0) {
      return std::chrono::seconds(std::min(seconds, kMaxWait));
    }
  }
  return std::nullopt;
}

void noteWait(std::chrono::seconds wait, HttpReply& reply) {
  reply.headers["Preference-Applied"] = "wait=" + std::to_string(wait.count());
}

HttpReply parkFor(const Topic& topic, std::chrono::seconds wait) {
  HttpReply reply;
  reply.park = Park{topic, wait};
  return reply;
}

Handler withWait(JobPort& jobs, Handler submit) {
  return [&jobs, submit = std::move(submit)](HttpRequest& request) {
    const std::optional<std::chrono::seconds> wait = findWait(request);
    if (request.captures.count(kSubmittedJob) == 0) {
      HttpReply reply = submit(request);
      const bool is_new = reply.status == 202 && reply.headers.count("Idempotency-Replayed") == 0;
      if (!wait || !is_new) {
        return reply;
      }
      const std::string& location = reply.headers.at("Location");
      request.captures[kSubmittedJob] = location.substr(location.rfind('/') + 1);
    }
    const std::string& id = request.captures.at(kSubmittedJob);
    const JobView job = jobs.find(request.identity, id);
    if (!isFinal(job.state) && !request.wait_is_over) {
      return parkFor(id, *wait);
    }
    HttpReply reply = replyCreated(202, "/v1/jobs/" + id, renderJob(job));
    noteWait(*wait, reply);
    return reply;
  };
}

}  // namespace gaitmill::api
