#pragma once

#include <cstdint>
#include <string>

namespace gaitmill {

/// `gaitmill model validation`: the figures of core/validation for one model.
struct ValidateModelOptions {
  std::string path;    ///< model document
  std::string figure;  ///< empty = the list of those there are
  enum class Form { kVegaLite, kData, kSvg };
  Form form = Form::kVegaLite;
  std::uint64_t seed = 1;  ///< of random draws
};

/// The figure as text, or one line per figure; ends in a newline.
/// @throws Error of readFile and readOsim; kFigureNotFound
std::string describeValidation(const ValidateModelOptions& options);

}  // namespace gaitmill
