#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "core/analysis/emg_comparison.h"
#include "core/pipeline/job.h"

namespace gaitmill {

// EMG beside a job: it drives nothing and fails nothing. What cannot be used is a warning.

/// Reads, processes and maps the EMG part, if the trial has one and the stages make a motion.
/// @throws Error of readEmg if the file cannot be read at all
void openEmg(Job& job);

/// Warns after the first stage with activations where the recording does not cover them.
void warnOfEmg(Stage stage, Job& job);

/// The table "emg" after the first stage that has a motion, and again after those with activations:
/// every channel, rows at least 1 ms apart. Over time the part within the motion; over the cycle
/// the part within the activations, so that both are realigned at the same percent.
void addEmg(Stage stage, const Job& job, StageOutcome& outcome);

/// Every channel with known muscles against the activations of CMC, else of SO, over the gait
/// cycle; empty without one of them.
std::vector<EmgComparison> compareEmgs(const Job& job);

/// "emg" of summary.json: channels, processing with every parameter as it was used, delay, and the
/// comparison with the activations of CMC, else of SO. Needs job.emg.
nlohmann::ordered_json summarizeEmg(const Job& job);

}  // namespace gaitmill
