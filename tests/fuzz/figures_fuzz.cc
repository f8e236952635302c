#include <string>

#include "service/draw_task.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// What the process that draws sends, which a hostile model may have taken over.
GAITMILL_FUZZ_TARGET(figures) {
  const std::string again = encodeFigures(decodeFigures(std::string(input)));
  requirePromise(encodeFigures(decodeFigures(again)) == again, "figures come back as they are");
}

}  // namespace gaitmill
