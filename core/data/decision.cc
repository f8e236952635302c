#include "core/data/decision.h"

namespace gaitmill {

const char* originName(Decision::Origin origin) {
  switch (origin) {
    case Decision::Origin::kDetected:
      return "detected";
    case Decision::Origin::kStated:
      return "stated";
    case Decision::Origin::kSet:
      return "set";
    case Decision::Origin::kAssumed:
      break;
  }
  return "assumed";
}

}  // namespace gaitmill
