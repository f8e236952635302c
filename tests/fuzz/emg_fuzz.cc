#include <algorithm>
#include <functional>

#include "core/io/anc_reader.h"
#include "core/io/emg_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

void checkRecording(const EmgFile& file) {
  const TimeSeries& signals = file.signals;
  requirePromise(signals.rowCount() > 0 && signals.columnCount() > 0, "there is a value");
  requirePromise(
      signals.values.rows() == signals.rowCount() && signals.values.cols() == signals.columnCount(),
      "values fit channels and times");
  requirePromise(signals.units.size() == signals.labels.size(), "every channel has its unit");
  requirePromise(std::is_sorted(signals.time.begin(), signals.time.end(), std::less_equal<>()),
                 "times increase");
}

}  // namespace

GAITMILL_FUZZ_TARGET(emg) {
  tryParse([&] { checkRecording(readEmg(input, "fuzz.anc")); });
  tryParse([&] { readAnc(input, "fuzz.anc"); });
}

}  // namespace gaitmill
