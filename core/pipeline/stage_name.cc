#include "core/base/error.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

const char* stageName(Stage stage) {
  switch (stage) {
    case Stage::kScale:
      return "scale";
    case Stage::kIk:
      return "ik";
    case Stage::kRra:
      return "rra";
    case Stage::kId:
      return "id";
    case Stage::kSo:
      return "so";
    case Stage::kCmc:
      return "cmc";
  }
  throw Error(ErrorCode::kInternal, "stage without a name");
}

}  // namespace gaitmill
