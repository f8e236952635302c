#include <string>

#include "service/process/frames.h"
#include "service/process/messages.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// What a child process sends that a hostile file may have taken over.
GAITMILL_FUZZ_TARGET(child_frames) {
  FrameReader reader;
  reader.append(input.substr(0, input.size() / 2));
  reader.append(input.substr(input.size() / 2));
  while (const auto frame = reader.next()) {
    tryParse([&] { readErrorFrame(*frame); });
    tryParse([&] { unpackDouble(fieldOf(*frame, 1)); });
    requirePromise(encodeFrame(*frame).size() <= input.size(),
                   "a frame is no longer than its bytes");
  }
}

}  // namespace gaitmill
