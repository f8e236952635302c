#include "api/event_stream.h"

#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "api/dto/job.h"
#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"
#include "api/route_tools.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

bool saysFinal(const JobEvent& event) {
  if (event.kind != "state") {
    return false;
  }
  const auto data = nlohmann::json::parse(event.data);
  return isFinal(findJobState(data.at("state").get<std::string>()));
}

class JobReader {
 public:
  JobReader(JobPort& jobs, Identity who, std::string job_id, std::int64_t after)
      : jobs_(jobs), who_(std::move(who)), job_id_(std::move(job_id)), after_(after) {}

  std::string read(bool& ended) {
    std::string text = readNew(ended);
    // A job that was final before the stream began, or whose last event the client has already
    // seen. Looked at again, because that event may have come in between.
    if (text.empty() && isFinal(jobs_.find(who_, job_id_).state)) {
      text = readNew(ended);
      ended = true;
    }
    return text;
  }

 private:
  std::string readNew(bool& ended) {
    std::string text;
    while (!ended) {
      const std::vector<JobEvent> events = jobs_.listEvents(who_, job_id_, after_);
      if (events.empty()) {
        break;
      }
      for (const JobEvent& event : events) {
        text += renderEvent(event);
        after_ = event.id;
        ended = ended || saysFinal(event);
      }
    }
    return text;
  }

  JobPort& jobs_;
  Identity who_;
  std::string job_id_;
  std::int64_t after_;
};

}  // namespace

EventFeed makeJobFeed(JobPort& jobs,
                      const Identity& who,
                      const std::string& job_id,
                      std::int64_t after) {
  jobs.find(who, job_id);
  EventFeed feed;
  feed.topic = job_id;
  feed.next = [reader = JobReader(jobs, who, job_id, after)](bool& ended) mutable {
    try {
      return reader.read(ended);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kJobNotFound) {
        throw;
      }
      ended = true;  // deleted while somebody watched
      return std::string();
    }
  };
  return feed;
}

std::string renderEvent(const JobEvent& event) {
  auto data = nlohmann::json::parse(event.data);
  data["at"] = formatTimestamp(event.at);
  return "id: " + std::to_string(event.id) + "\nevent: " + event.kind +
         "\ndata: " + dumpJson(data) + "\n\n";
}

std::int64_t findLastEventId(const HttpRequest& request) {
  const std::string& header = request.header("last-event-id");
  const std::string text = header.empty() ? queryOf(request, "last_event_id") : header;
  std::int64_t id = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, id);
  require(text.empty() || (parsed.ec == std::errc() && parsed.ptr == end && id >= 0),
          ErrorCode::kRequestField,
          "the id of the last event must be a whole number",
          {"", 0, 0, header.empty() ? "last_event_id" : "Last-Event-ID"});
  return id;
}

}  // namespace gaitmill::api
