#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gaitmill {

/// Names and bytes of a zip file in its order, as a reader that is not ours sees them and checks
/// their sums. A test failure if it cannot.
std::vector<std::pair<std::string, std::string>> readZip(const std::string& zip);

}  // namespace gaitmill
