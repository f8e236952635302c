#pragma once

#include <map>
#include <string>
#include <vector>

namespace gaitmill {

enum class BodySide { kRight, kLeft };

/// "right", "left"
const char* sideName(BodySide side);

struct EmgChannelOptions {
  BodySide side = BodySide::kRight;  ///< of channels whose name states none
  /// Muscles by channel, in place of what its name says. Muscles of the model, or their names
  /// without side. An empty list leaves the channel out.
  std::map<std::string, std::vector<std::string>> channels;
};

/// One channel and the muscles whose mean activation it is held against.
struct EmgChannel {
  std::string channel;               ///< as the file names it
  int column = 0;                    ///< of the recording
  std::vector<std::string> muscles;  ///< in the model's order; empty if nothing is known
  BodySide side = BodySide::kRight;
};

struct EmgChannels {
  std::vector<EmgChannel> channels;   ///< in the order of the recording
  std::vector<std::string> warnings;  ///< names that nobody knows
};

/// Tells from the names of channels what they measured. A name is taken for
///  - a muscle of the model, its side written in any way ("soleus_r", "glmax1r", "R soleus");
///  - an abbreviation in use ("GAS", "TA", "MH", "BFLH", "GMAX", "MG");
///  - words of its anatomical name, shortened or not ("LT TIB.ANT.", "vastus_lateralis",
///    "R BICEPS FEMORIS: EMG 3").
/// The side stands in front or behind: r, R., rt, right and their left counterparts, also without
/// anything between ("RTA", "SOLL"). Words that say nothing about the muscle ("EMG", "Voltage",
/// numbers) count for nothing. A gastrocnemius or hamstring channel without head maps to all heads
/// that the words allow; biceps femoris to its long head (spec/paper_metrics.md D1).
/// @param labels   channels in the order of the recording's columns
/// @param muscles  of the model, "soleus_r"; without any, the project's own model is meant
EmgChannels mapEmgChannels(const std::vector<std::string>& labels,
                           const std::vector<std::string>& muscles,
                           const EmgChannelOptions& options);

}  // namespace gaitmill
