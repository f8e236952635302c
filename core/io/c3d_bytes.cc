#include "core/io/c3d_bytes.h"

namespace gaitmill {

std::uint16_t C3dBytes::word(std::size_t offset) const {
  if (offset > bytes_.size() || bytes_.size() - offset < 2) {
    return 0;
  }
  const char* const at = bytes_.data() + offset;
  return processor_ == C3dProcessor::kMips ? c3d::readWord<C3dProcessor::kMips>(at)
                                           : c3d::readWord<C3dProcessor::kIntel>(at);
}

float C3dBytes::real(std::size_t offset) const {
  if (offset > bytes_.size() || bytes_.size() - offset < 4) {
    return 0;
  }
  const char* const at = bytes_.data() + offset;
  switch (processor_) {
    case C3dProcessor::kIntel:
      return c3d::readReal<C3dProcessor::kIntel>(at);
    case C3dProcessor::kDec:
      return c3d::readReal<C3dProcessor::kDec>(at);
    case C3dProcessor::kMips:
      break;
  }
  return c3d::readReal<C3dProcessor::kMips>(at);
}

}  // namespace gaitmill
