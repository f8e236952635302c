#pragma once

#include <string>
#include <vector>

#include "api/dto/job.h"
#include "api/dto/result.h"
#include "api/dto/trial.h"
#include "core/data/time_series.h"

namespace gaitmill::api {

/// All that a route may ask for. Implemented by the service on top of its storage, and by recording
/// stubs in tests. Implementations are called from several threads at once and answer quickly: no
/// solver runs behind a port.

class TrialPort {
 public:
  virtual ~TrialPort() = default;
  /// Reads every file, stores the trial durably and says what was understood.
  /// @throws Error of the parser with file, line and column; kInputMissing; kRequestField
  virtual TrialView submit(TrialUpload upload) = 0;
  /// @throws Error kTrialNotFound
  virtual TrialView find(const std::string& trial_id) = 0;
};

class JobPort {
 public:
  virtual ~JobPort() = default;
  /// Durable before it returns. @throws Error kTrialNotFound, kSettings..., kInputMissing
  virtual JobView submit(const JobRequest& request) = 0;
  /// @throws Error kJobNotFound
  virtual JobView find(const std::string& job_id) = 0;
  /// A queued job is cancelled at once, a running one at its solver's next step.
  /// @throws Error kJobNotFound; kJobState if the job has already succeeded or failed
  virtual JobView cancel(const std::string& job_id) = 0;
};

class ResultPort {
 public:
  virtual ~ResultPort() = default;
  /// A table in SI units and radians; on the cycle axis `time` holds percent.
  /// @throws Error kJobNotFound; kResultNotReady before the job has succeeded; kResultNotFound
  virtual TimeSeries findTable(const std::string& job_id,
                               const std::string& name,
                               TableAxis axis) = 0;
  /// The quality figures, a JSON object. @throws as findTable
  virtual std::string findQuality(const std::string& job_id) = 0;
  /// Bytes of an OpenSim storage file with the table's angles in this unit, as its header says.
  virtual std::string encodeSto(const TimeSeries& table, AngleUnit angles) = 0;
  virtual std::vector<FileView> listFiles(const std::string& job_id) = 0;
  virtual FileContent findFile(const std::string& job_id, const std::string& name) = 0;
};

struct Ports {
  TrialPort& trials;
  JobPort& jobs;
  ResultPort& results;
};

}  // namespace gaitmill::api
