#pragma once

#include <cstdint>
#include <string>

#include "api/ports.h"

namespace gaitmill::api {

/// The events of a job as server-sent events: those after `after`, then what comes; ends after the
/// one that says that the job is final. @throws Error kJobNotFound
EventFeed makeJobFeed(JobPort& jobs,
                      const Identity& who,
                      const std::string& job_id,
                      std::int64_t after);

/// "id: 7\nevent: stage\ndata: {…}\n\n"; the time of the event stands in its data as "at".
std::string renderEvent(const JobEvent& event);

/// Where a stream resumes: the header Last-Event-ID, else the parameter last_event_id, else 0.
/// @throws Error kRequestField
std::int64_t findLastEventId(const HttpRequest& request);

}  // namespace gaitmill::api
