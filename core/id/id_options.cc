#include "core/id/id_options.h"

#include "core/base/error.h"

namespace gaitmill {

void IdOptions::validate() const {
  require(!lowpass_cutoff || *lowpass_cutoff > 0,
          ErrorCode::kSettingsValue,
          "low-pass cutoff must be above 0 Hz",
          {"", 0, 0, "lowpass_cutoff_hz"});
  require(start_time <= end_time,
          ErrorCode::kSettingsValue,
          "the time range ends before it starts",
          {"", 0, 0, "end_time_s"});
}

}  // namespace gaitmill
