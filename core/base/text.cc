#include "core/base/text.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace gaitmill {

std::string formatFixed(double value, int decimals) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

}  // namespace gaitmill
