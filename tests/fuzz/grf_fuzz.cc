#include <string>
#include <vector>

#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(grf) {
  const TableFile file = readTable(input, "fuzz.mot");
  const std::vector<std::string> families = findForceFamilies(file.table.labels);
  const auto check = [&](const GrfOptions& options) {
    for (const ExternalForce& force : readGroundReaction(file, options).forces) {
      requirePromise(force.force.cols() == file.table.rowCount(), "a force has all instants");
      requirePromise(force.force.allFinite(), "no force is missing");
    }
  };
  tryParse([&] { check({}); });
  GrfOptions assigned;
  assigned.threshold = 0;
  for (const std::string& family : families) {
    assigned.plates.push_back({family, "calcn_r"});
  }
  tryParse([&] { check(assigned); });
}

}  // namespace gaitmill
