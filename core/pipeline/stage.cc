#include <array>
#include <cstddef>

#include "core/base/error.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

namespace {

constexpr std::array<const char*, kStageCount> kStageNames = {
    "scale", "ik", "rra", "id", "so", "cmc"};

}  // namespace

const char* stageName(Stage stage) {
  return kStageNames[static_cast<std::size_t>(stage)];
}

Stage parseStage(const std::string& name) {
  std::string known;
  for (int i = 0; i < kStageCount; ++i) {
    const Stage stage = static_cast<Stage>(i);
    if (name == stageName(stage)) {
      return stage;
    }
    known += (i == 0 ? "" : ", ") + std::string(stageName(stage));
  }
  throw Error(ErrorCode::kSettingsValue,
              "there is no stage '" + name + "'; expected one of " + known);
}

}  // namespace gaitmill
