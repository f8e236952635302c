#include "service/render_command.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "api/dto/image.h"
#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "service/image_task.h"
#include "service/run_command.h"

namespace gaitmill {

namespace {

namespace fs = std::filesystem;

// Which files of a run hold what, the last stage's first.
const std::vector<std::string>& motionFiles() {
  static const std::vector<std::string> files = {"cmc_kinematics.mot", "rra.mot", "ik.mot"};
  return files;
}

std::vector<std::string> valueFiles(MuscleColor color) {
  switch (color) {
    case MuscleColor::kActivation:
      return {"cmc_activations.sto", "so_activations.sto"};
    case MuscleColor::kForce:
      return {"cmc_forces.sto", "so_forces.sto"};
    case MuscleColor::kFiberLength:
      return {std::string(kTablesFolder) + "/norm_fiber_lengths.sto"};
    case MuscleColor::kNone:
      break;
  }
  return {};
}

// The first that is there, or empty.
std::string findFirst(const std::string& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const fs::path path = fs::path(folder) / name;
    if (fs::is_regular_file(path)) {
      return path.string();
    }
  }
  return "";
}

// The files of a run in place of what was not given.
RenderOptions completeFromResults(RenderOptions options, MuscleColor color) {
  if (options.results.empty()) {
    return options;
  }
  const auto complete = [&options](std::string& path, const std::vector<std::string>& names) {
    path = path.empty() ? findFirst(options.results, names) : path;
  };
  complete(options.model, {kMotionModel, "scaled_model.osim"});
  complete(options.motion, motionFiles());
  complete(options.muscle_values, valueFiles(color));
  return options;
}

void requirePart(const std::string& path, const char* option) {
  require(!path.empty(),
          ErrorCode::kInputMissing,
          std::string("an image needs --results or --") + option,
          {"", 0, 0, option});
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

api::ImageKind findKind(const RenderOptions& options) {
  if (endsWith(options.out, ".webp")) {
    return api::ImageKind::kAnimation;
  }
  require(endsWith(options.out, ".png"),
          ErrorCode::kRequestField,
          "'" + options.out + "' must end in .png, or in .webp for an animation",
          {"", 0, 0, "out"});
  return options.parameters.count("poses") > 0 ? api::ImageKind::kStrip : api::ImageKind::kPose;
}

api::ImageRequest readRequest(const RenderOptions& options) {
  const api::ImageKind kind = findKind(options);
  const std::vector<std::string> known = api::imageParameters(kind);
  for (const auto& [name, value] : options.parameters) {
    require(std::find(known.begin(), known.end(), name) != known.end(),
            ErrorCode::kRequestField,
            "--" + name + " does not belong to this kind of image",
            {"", 0, 0, name});
  }
  return api::parseImageRequest(kind, [&options](const std::string& name) {
    const auto found = options.parameters.find(name);
    return found == options.parameters.end() ? std::nullopt
                                             : std::optional<std::string>(found->second);
  });
}

/// A result table of a run; without columns if it is not there.
TimeSeries readResult(const std::string& results, const std::string& name) {
  const std::string path = findFirst(results, {std::string(kTablesFolder) + "/" + name + ".sto"});
  return path.empty() ? TimeSeries() : readTable(readFile(path), path).table;
}

DrawData readData(const RenderOptions& files) {
  DrawData data;
  data.model_name = files.model;
  data.picture.model_osim = readFile(files.model);
  const ModelSpec model = readOsim(data.picture.model_osim, files.model);
  std::vector<std::string> ignored;
  data.picture.kinematics =
      toCoordinates(readTable(readFile(files.motion), files.motion), model, &ignored);
  if (!files.muscle_values.empty()) {
    data.picture.muscle_values =
        readTable(readFile(files.muscle_values), files.muscle_values).table;
  }
  if (!files.results.empty()) {
    data.picture.ground_reactions = readResult(files.results, "ground_reactions");
    data.picture.markers = readResult(files.results, "measured_markers");
  }
  const fs::path summary = fs::path(files.results) / "summary.json";
  const CycleSpan cycle = !files.results.empty() && fs::is_regular_file(summary)
                              ? findCycleSpan(readFile(summary.string()))
                              : CycleSpan{};
  if (cycle.exists()) {
    data.picture.cycle = GaitCycle{cycle.start, cycle.end};
  }
  return data;
}

}  // namespace

void renderFiles(const RenderOptions& options, const Drawing& draw, std::ostream& report) {
  const api::ImageRequest request = readRequest(options);
  const RenderOptions files = completeFromResults(options, parseMuscleColor(request.color));
  requirePart(files.model, "model");
  requirePart(files.motion, "motion");
  const DrawData data = readData(files);
  const CycleSpan cycle = data.picture.cycle
                              ? CycleSpan{data.picture.cycle->start, data.picture.cycle->end}
                              : CycleSpan{};
  const DrawTask task = makeDrawTask(request, data.picture.kinematics, cycle);
  countPixels(task);
  const Picture picture = draw(task, data);
  writeFile(options.out, picture.bytes);
  report << options.out << ": " << picture.bytes.size() << " bytes of " << picture.content_type
         << '\n';
}

}  // namespace gaitmill
