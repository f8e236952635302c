#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// What was read can be written, and the document written can be read.
GAITMILL_FUZZ_TARGET(osim) {
  std::vector<std::string> warnings;
  const ModelSpec spec = readOsim(input, "fuzz.osim", &warnings);
  tryParse([&] { readMarkerSet(input, "fuzz.osim", spec); });
  try {
    readOsim(writeOsim(spec), "written.osim");
  } catch (const Error& error) {
    requirePromise(false, error.what());
  }
}

}  // namespace gaitmill
