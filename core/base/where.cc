#include "core/base/where.h"

namespace gaitmill {

Where atTime(double seconds) {
  Where where;
  where.time = seconds;
  return where;
}

Where atMarker(const std::string& name) {
  Where where;
  where.marker = name;
  return where;
}

Where atMuscle(const std::string& name) {
  Where where;
  where.muscle = name;
  return where;
}

Where atCoordinate(const std::string& name) {
  Where where;
  where.coordinate = name;
  return where;
}

}  // namespace gaitmill
