#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/dto/trial.h"
#include "core/base/error.h"
#include "core/pipeline/pipeline.h"
#include "service/process/child.h"
#include "service/process/conversation.h"

namespace gaitmill {

/// What a job runs on. Parts are those of api::trialParts(), and "marker_set".
struct SolveRequest {
  InputFile settings;
  double mass = 0;    ///< [kg]
  double height = 0;  ///< [m]
  std::map<std::string, api::UploadedFile> parts;
  std::vector<std::string> checkpoints;  ///< of the stages that have finished, in order
};

/// One thing a job has produced, as bytes; tables as by encodeTable().
struct SolvedItem {
  enum class Kind : char { kFile = 'f', kTime = 't', kCycle = 'c', kSummary = 's' };
  Kind kind = Kind::kFile;
  std::string name;
  std::string bytes;
};

struct SolvedStage {
  Stage stage = Stage::kScale;
  std::string checkpoint;
  std::vector<SolvedItem> items;  ///< those this stage has added or changed
};

/// Hears how a job goes, in the thread that runs it.
class SolveListener {
 public:
  virtual ~SolveListener() = default;
  virtual void progress(Stage stage, double fraction) = 0;
  virtual void warn(const std::string& sentence) = 0;
  virtual void finish(SolvedStage stage) = 0;
  /// One line of the solver's standard error.
  virtual void print(const std::string& line) = 0;
  /// Asked every tick, and at once after an interrupt; false kills the solver.
  virtual bool goesOn() = 0;
};

struct SolveLimits {
  std::chrono::milliseconds stage{900'000};    ///< one stage may take
  std::chrono::milliseconds silence{120'000};  ///< a solver may go without a word
  std::chrono::milliseconds tick{2'000};
  ChildLimits child;
};

struct SolveOutcome {
  enum class End {
    kSucceeded,
    kFailed,   ///< the pipeline refused its input; `error` is its own
    kDied,     ///< `error` is kJobCrashed, kJobTimeout or kJobMemory, with the stage
    kStopped,  ///< SolveListener::goesOn said so
  };
  End end = End::kDied;
  std::vector<SolvedItem> items;      ///< of a success: those that no stage has announced
  std::string verdict;                ///< of a success: "pass", "warn" or "fail"
  std::vector<std::string> warnings;  ///< of a success: all of them
  std::optional<Error> error;
};

/// Runs one job in a child process and sees to it that it ends: killed on a stage's time limit, on
/// silence, and when it is no longer wanted. The child is gone when this returns, whatever happens.
/// @param interrupt  raised by other threads to have goesOn() asked at once; may be null
/// @throws what the listener throws; Error kStorage of a part; kInternal if no child can be had
SolveOutcome solveInChild(const ChildCommand& command,
                          const SolveRequest& request,
                          const SolveLimits& limits,
                          SolveListener& listener,
                          const Interrupt* interrupt = nullptr);

}  // namespace gaitmill
