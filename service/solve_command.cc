#include "service/solve_command.h"

#include <cstdlib>
#include <exception>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/draw_task.h"
#include "service/job_input.h"
#include "service/process/child_channel.h"
#include "service/process/messages.h"
#include "service/process/solver_process.h"
#include "service/storage/sha256.h"
#include "service/storage/table_codec.h"

namespace gaitmill {

namespace {

// What the service says until kGo.
struct Assignment {
  InputFile settings;
  double mass = 0;    ///< [kg]
  double height = 0;  ///< [m]
  std::map<std::string, InputFile> parts;
  std::vector<std::string> checkpoints;
};

Assignment receiveAssignment(ChildChannel& channel) {
  Assignment assignment;
  std::string* target = &assignment.settings.bytes;
  while (true) {
    Frame frame = channel.receive();
    switch (messageOf(frame)) {
      case Message::kSubject:
        assignment.mass = unpackDouble(fieldOf(frame, 0));
        assignment.height = unpackDouble(fieldOf(frame, 1));
        break;
      case Message::kSettings:
        assignment.settings.name = fieldOf(frame, 0);
        target = &assignment.settings.bytes;
        break;
      case Message::kPart: {
        InputFile& part = assignment.parts[fieldOf(frame, 0)];
        part.name = fieldOf(frame, 1);
        target = &part.bytes;
        break;
      }
      case Message::kCheckpoint:
        target = &assignment.checkpoints.emplace_back();
        break;
      case Message::kData:
        *target += fieldOf(frame, 0);
        break;
      case Message::kGo:
        return assignment;
      default:
        throw Error(ErrorCode::kInternal, "the service says what only its children say");
    }
  }
}

TrialInput takeTrialInput(Assignment& assignment) {
  JobInput input;
  input.mass = assignment.mass;
  input.height = assignment.height;
  for (auto& [part, file] : assignment.parts) {
    input.parts[part] = {file.name, api::makeByteSource(std::move(file.bytes))};
  }
  return makeTrialInput(input);
}

// Tells of results, each only when its bytes are new.
class ResultTeller {
 public:
  explicit ResultTeller(ChildChannel& channel) : channel_(channel) {}

  void tell(SolvedItem::Kind kind, const std::string& name, const std::string& bytes) {
    std::string& told = told_[{kind, name}];
    std::string hash = calcSha256(bytes);
    if (told != hash) {
      told = std::move(hash);
      channel_.sendItem(makeFrame(Message::kItem, {std::string(1, static_cast<char>(kind)), name}),
                        bytes);
    }
  }
  void tellAll(const std::map<std::string, std::string>& files,
               const std::map<std::string, TimeSeries>& tables,
               const std::map<std::string, TimeSeries>& cycle_tables) {
    for (const auto& [name, bytes] : files) {
      tell(SolvedItem::Kind::kFile, name, bytes);
    }
    for (const auto& [name, table] : tables) {
      tell(SolvedItem::Kind::kTime, name, encodeTable(table));
    }
    for (const auto& [name, table] : cycle_tables) {
      tell(SolvedItem::Kind::kCycle, name, encodeTable(table));
    }
  }

 private:
  ChildChannel& channel_;
  std::map<std::pair<SolvedItem::Kind, std::string>, std::string> told_;
};

PipelineEvents makeEvents(ChildChannel& channel, ResultTeller& results) {
  PipelineEvents events;
  events.progress = [&channel](Stage stage, double fraction) {
    channel.send(makeFrame(Message::kProgress, {stageName(stage), packDouble(fraction)}));
    return true;
  };
  events.warn = [&channel](const std::string& sentence) {
    channel.send(makeFrame(Message::kWarning, {sentence}));
  };
  events.stage_done = [&channel, &results](const StageOutcome& outcome) {
    results.tellAll(outcome.files, outcome.tables, outcome.cycle_tables);
    channel.sendItem(makeFrame(Message::kCheckpoint), outcome.checkpoint);
    channel.send(makeFrame(Message::kStageDone, {stageName(outcome.stage)}));
  };
  return events;
}

// Checkpoints that another version of the code has left are no reason to fail: the job starts over.
PipelineResult runFromCheckpoints(const TrialInput& input,
                                  const Assignment& assignment,
                                  const PipelineEvents& events,
                                  const PipelineRunner& run) {
  try {
    return run(input, assignment.settings, events, assignment.checkpoints);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kCheckpointUnusable) {
      throw;
    }
  }
  return run(input, assignment.settings, events, {});
}

void solve(ChildChannel& channel, Assignment assignment, const PipelineRunner& run) {
  ResultTeller results(channel);
  const TrialInput input = takeTrialInput(assignment);
  const PipelineResult result =
      runFromCheckpoints(input, assignment, makeEvents(channel, results), run);
  results.tellAll(result.files, result.tables, result.cycle_tables);
  results.tell(SolvedItem::Kind::kSummary, "summary", result.summary_json);
  const auto summary = nlohmann::json::parse(result.summary_json);
  results.tell(SolvedItem::Kind::kSummary,
               "quality",
               summary.value("quality", nlohmann::json::object()).dump());
  const std::string verdict = result.warnings.empty() ? "pass" : "warn";
  std::vector<std::string> end = {summary.value("verdict", verdict)};
  end.insert(end.end(), result.warnings.begin(), result.warnings.end());
  channel.send(makeFrame(Message::kDone, std::move(end)));
}

void inspect(ChildChannel& channel, Assignment assignment, const TrialInspector& inspector) {
  api::TrialUpload upload;
  upload.subject.mass = assignment.mass;
  upload.subject.height = assignment.height;
  for (auto& [part, file] : assignment.parts) {
    upload.files[part] = {file.name, api::makeByteSource(std::move(file.bytes))};
  }
  const api::TrialView view = inspector(upload);
  channel.sendItem(makeFrame(Message::kUnderstood, view.warnings), api::encodeUnderstanding(view));
  channel.send(makeFrame(Message::kDone));
}

// What the service says until kGo. Parts stay from one task to the next unless new ones come.
std::string receiveTask(ChildChannel& channel, std::optional<DrawData>& data) {
  std::string task;
  std::map<std::string, std::string> parts;
  std::string* target = nullptr;
  while (true) {
    const Frame frame = channel.receive();
    switch (messageOf(frame)) {
      case Message::kTask:
        task = fieldOf(frame, 0);
        break;
      case Message::kPart:
        target = &parts[fieldOf(frame, 0)];
        break;
      case Message::kData:
        check(target != nullptr, "bytes of nothing");
        *target += fieldOf(frame, 0);
        break;
      case Message::kGo:
        data = parts.empty() ? std::move(data) : decodeDrawData(std::move(parts));
        return task;
      default:
        throw Error(ErrorCode::kInternal, "the service says what only its children say");
    }
  }
}

void drawNext(ChildChannel& channel, const Drawing& draw, std::optional<DrawData>& data) {
  const DrawTask task = decodeDrawTask(receiveTask(channel, data));
  check(data.has_value(), "there is nothing to draw from");
  const Picture picture = draw(task, *data);
  channel.sendItem(makeFrame(Message::kItem, {picture.content_type}), picture.bytes);
  channel.send(makeFrame(Message::kDone));
}

// Ends with the channel, or is killed.
[[noreturn]] void drawForever(ChildChannel& channel, const Drawing& draw) {
  std::optional<DrawData> data;
  while (true) {
    try {
      drawNext(channel, draw, data);
    } catch (const Error& error) {
      channel.send(makeErrorFrame(error));
    } catch (const std::exception& error) {
      channel.send(makeErrorFrame(Error(ErrorCode::kRender, error.what())));
    }
  }
}

void work(ChildChannel& channel, const ChildOptions& options, const PipelineFunctions& functions) {
  if (options.task == ChildOptions::Task::kDraw) {
    drawForever(channel, functions.make_drawing(options.geometry));
  }
  Assignment assignment = receiveAssignment(channel);
  if (options.task == ChildOptions::Task::kInspect) {
    inspect(channel, std::move(assignment), functions.inspect);
  } else {
    solve(channel, std::move(assignment), functions.run);
  }
}

}  // namespace

int runChild(const ChildOptions& options, const PipelineFunctions& functions) {
  becomeChild(options.parent, options.limits, encodeFrame(makeFrame(Message::kOutOfMemory)));
  ChildChannel channel(Child::kChannelFd);
  try {
    work(channel, options, functions);
    return EXIT_SUCCESS;
  } catch (const Error& error) {
    channel.send(makeErrorFrame(error));
  } catch (const std::exception& error) {
    channel.send(makeErrorFrame(Error(ErrorCode::kInternal, error.what())));
  }
  return EXIT_FAILURE;
}

}  // namespace gaitmill
