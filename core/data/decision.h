#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Something about a recording that its files leave open, and what it was taken for. Nothing of the
/// kind is decided silently: a job's summary and the answer to an upload list every one.
struct Decision {
  enum class Origin {
    kDetected,  ///< follows from the data
    kStated,    ///< a file says so
    kSet,       ///< a settings field says so
    kAssumed,   ///< neither: the usual convention
  };
  std::string part;   ///< of the trial: "markers", "grf"; empty = of the whole trial
  std::string topic;  ///< "vertical_axis"
  std::string field;  ///< settings field that overrides it, "trial.vertical_axis"
  std::string value;  ///< as that field takes it: "z"
  Origin origin = Origin::kAssumed;
  double confidence = 1;  ///< 0..1
  std::string evidence;   ///< one sentence with the numbers
};

using Decisions = std::vector<Decision>;

/// "detected", "stated", "set", "assumed"
const char* originName(Decision::Origin origin);

}  // namespace gaitmill
