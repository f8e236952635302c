#include "core/pipeline/job_emg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/emg_comparison.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/io/emg_reader.h"
#include "core/pipeline/intake.h"
#include "core/pipeline/quality_json.h"

namespace gaitmill {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kLeastRowDistance = 1e-3;  // [s]
// Rows are this exact; a recording that ends this much early still covers [s].
constexpr double kTimeSlack = 2e-3;

struct NamedActivations {
  const char* stage;
  const TimeSeries* table;
};

std::optional<NamedActivations> findActivations(const Job& job) {
  if (job.cmc) {
    return NamedActivations{"cmc", &job.cmc->activation};
  }
  if (job.so) {
    return NamedActivations{"so", &job.so->activations};
  }
  return std::nullopt;
}

std::vector<std::string> listMuscles(const Job& job) {
  std::vector<std::string> names;
  const ModelSpec& model = job.scaled.joints.empty() ? job.generic : job.scaled;
  for (const MuscleSpec& muscle : model.muscles) {
    names.push_back(muscle.name);
  }
  return names;
}

/// Every `step`th row of a table from `first` to `last`, of the channels that are used.
TimeSeries pickRows(const JobEmg& emg, int first, int last, int step) {
  const TimeSeries& source = emg.processed.envelopes;
  std::vector<double> time;
  for (int row = first; row <= last; row += step) {
    time.push_back(source.time[static_cast<std::size_t>(row)]);
  }
  TimeSeries picked = makeTimeSeries("emg", {}, std::move(time));
  for (const EmgChannel& channel : emg.channels) {
    picked.labels.push_back(channel.channel);
    picked.units.push_back(source.units[static_cast<std::size_t>(channel.column)]);
  }
  picked.values.resize(picked.rowCount(), picked.columnCount());
  for (Eigen::Index row = 0; row < picked.values.rows(); ++row) {
    for (Eigen::Index i = 0; i < picked.values.cols(); ++i) {
      picked.values(row, i) =
          source.values(first + row * step, emg.channels[static_cast<std::size_t>(i)].column);
    }
  }
  return picked;
}

/// The rows within the times of `covered` and one more at each end; no rows if they have no time in
/// common.
TimeSeries cutToTimes(const JobEmg& emg, const TimeSeries& covered) {
  const std::vector<double>& time = emg.processed.envelopes.time;
  if (time.back() < covered.time.front() || time.front() > covered.time.back()) {
    return {};
  }
  const auto first = std::lower_bound(time.begin(), time.end(), covered.time.front());
  const auto last = std::upper_bound(time.begin(), time.end(), covered.time.back());
  const int step =
      std::max(1, static_cast<int>(std::ceil(kLeastRowDistance * emg.processed.rate - 1e-6)));
  const auto rows = static_cast<int>(time.size());
  return pickRows(emg,
                  std::max(0, static_cast<int>(first - time.begin()) - step),
                  std::min(rows - 1, static_cast<int>(last - time.begin()) - 1 + step),
                  step);
}

bool isFirstWithMotion(Stage stage, const PipelineSettings& settings) {
  for (int i = static_cast<int>(Stage::kIk); i < static_cast<int>(stage); ++i) {
    if (settings.runs(static_cast<Stage>(i))) {
      return false;
    }
  }
  return stage >= Stage::kIk;
}

bool makesActivations(Stage stage) {
  return stage == Stage::kSo || stage == Stage::kCmc;
}

Json toJson(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json summarizeChannels(const JobEmg& emg) {
  Json channels = Json::array();
  for (const EmgChannel& channel : emg.channels) {
    channels.push_back({{"channel", channel.channel},
                        {"muscles", channel.muscles},
                        {"side", sideName(channel.side)}});
  }
  return channels;
}

Json summarizeProcessing(const Job& job) {
  const EmgEnvelopes& processed = job.emg->processed;
  const EmgOptions& used = processed.used;
  const bool raw = processed.source == EmgSource::kRaw;
  Json band = nullptr;
  if (used.band_pass) {
    band = {used.band_pass->low, used.band_pass->high};
  }
  return {{"source", raw ? "raw" : "envelope"},
          {"source_told_from", job.settings.emg.source == EmgSource::kAuto ? "signal" : "settings"},
          {"filtered", raw},
          {"rate_hz", toJsonNumber(processed.rate)},
          {"band_pass_hz", band},
          {"band_pass_order", used.band_pass_order},
          {"butterworth_hz", toJson(used.butterworth)},
          {"butterworth_order", used.butterworth_order},
          {"critically_damped_hz", toJson(used.critically_damped)},
          {"critically_damped_passes", used.critically_damped_passes},
          {"ends", used.ends == EdgeTreatment::kZeroStart ? "zero_start" : "reflected"}};
}

Json summarizeBursts(const std::vector<ActivityBurst>& bursts) {
  Json list = Json::array();
  for (const ActivityBurst& burst : bursts) {
    list.push_back({toJsonNumber(burst.onset), toJsonNumber(burst.offset)});
  }
  return list;
}

Json summarizeComparison(const EmgComparison& comparison) {
  return {{"channel", comparison.channel},
          {"muscles", comparison.muscles},
          {"side", sideName(comparison.side)},
          {"instants", comparison.instants},
          {"emg_peak", toJsonNumber(comparison.emg_peak)},
          {"activation_peak", toJsonNumber(comparison.activation_peak)},
          {"scale", toJsonNumber(comparison.scale)},
          {"rms_difference_of_peak", toJsonNumber(comparison.rms_difference)},
          {"overlap", toJsonNumber(comparison.overlap)},
          {"emg_bursts_percent", summarizeBursts(comparison.emg_bursts)},
          {"simulated_bursts_percent", summarizeBursts(comparison.simulated_bursts)},
          {"onset_difference_percent", toJsonNumber(comparison.onset_difference)},
          {"offset_difference_percent", toJsonNumber(comparison.offset_difference)},
          {"correlation", toJsonNumber(comparison.correlation)},
          {"lag_percent", toJsonNumber(comparison.lag)},
          {"correlation_without_lag", toJsonNumber(comparison.correlation_at_zero)}};
}

/// The movement's file may hold analog channels, or channels of no muscle: that is no fault then,
/// and its warnings were said with the markers.
std::optional<EmgFile> openRecording(const Job& job, const InputFile& file) {
  if (job.input->emg) {
    return readEmg(file.bytes, file.name);
  }
  EmgFile recording = takeEmg(readC3d(file.bytes, file.name));
  recording.warnings.clear();
  const EmgChannels mapped = mapEmgChannels(recording.signals.labels, {}, job.settings.emg.mapping);
  const bool any = std::any_of(mapped.channels.begin(),
                               mapped.channels.end(),
                               [](const EmgChannel& channel) { return !channel.muscles.empty(); });
  return any ? std::optional<EmgFile>(std::move(recording)) : std::nullopt;
}

}  // namespace

std::vector<EmgComparison> compareEmgs(const Job& job) {
  std::vector<EmgComparison> comparisons;
  const std::optional<NamedActivations> activations = findActivations(job);
  const std::optional<GaitCycle> cycle = findGaitCycle(job);
  if (!job.emg || !activations || !cycle) {
    return comparisons;
  }
  for (const EmgChannel& channel : job.emg->channels) {
    if (!channel.muscles.empty()) {
      comparisons.push_back(
          compareEmg(job.emg->processed.envelopes, *activations->table, channel, *cycle));
    }
  }
  return comparisons;
}

void openEmg(Job& job) {
  const InputFile* const found = findEmgFile(*job.input);
  if (found == nullptr || job.settings.last < Stage::kIk) {
    return;
  }
  const InputFile& file = *found;
  std::optional<EmgFile> opened = openRecording(job, file);
  if (!opened) {
    return;
  }
  EmgFile& recording = *opened;
  for (const std::string& warning : recording.warnings) {
    job.warn(file.name + ": " + warning);
  }
  EmgChannels mapped =
      mapEmgChannels(recording.signals.labels, listMuscles(job), job.settings.emg.mapping);
  for (const std::string& warning : mapped.warnings) {
    job.warn(file.name + ": " + warning);
  }
  if (mapped.channels.empty()) {
    return;
  }
  try {
    JobEmg emg{
        calcEmgEnvelopes(recording.signals, job.settings.emg.source, job.settings.emg.processing),
        std::move(mapped.channels)};
    for (double& time : emg.processed.envelopes.time) {
      time += job.settings.emg.electromechanical_delay;
    }
    job.emg = std::move(emg);
  } catch (const Error& error) {
    job.warn(file.name + ": " + error.message() + "; the EMG is left out");
  }
}

void warnOfEmg(Stage stage, Job& job) {
  const bool second = stage == Stage::kCmc && job.settings.runs(Stage::kSo);
  if (!job.emg || !makesActivations(stage) || second) {
    return;
  }
  if (!findGaitCycle(job)) {
    job.warn("emg: no gait cycle is known, so that nothing is compared");
    return;
  }
  const std::vector<double>& measured = job.emg->processed.envelopes.time;
  const std::vector<double>& simulated = findActivations(job)->table->time;
  if (measured.front() > simulated.front() + kTimeSlack ||
      measured.back() < simulated.back() - kTimeSlack) {
    job.warn("emg: the recording (" + formatFixed(measured.front(), 3) + " to " +
             formatFixed(measured.back(), 3) + " s) does not cover the simulated time (" +
             formatFixed(simulated.front(), 3) + " to " + formatFixed(simulated.back(), 3) +
             " s); the comparison is partial");
  }
}

void addEmg(Stage stage, const Job& job, StageOutcome& outcome) {
  const bool shows = isFirstWithMotion(stage, job.settings) || makesActivations(stage);
  if (!job.emg || !shows) {
    return;
  }
  const TimeSeries& motion = job.measured_coordinates;
  TimeSeries table = cutToTimes(*job.emg, motion);
  if (table.rowCount() < 2) {
    return;
  }
  const std::optional<GaitCycle> cycle = findGaitCycle(job);
  const std::optional<NamedActivations> activations = findActivations(job);
  const TimeSeries covered = cutToTimes(*job.emg, activations ? *activations->table : job.motion);
  if (cycle && covered.rowCount() >= 2) {
    outcome.cycle_tables["emg"] = normalizeToCycle(covered, *cycle);
  }
  outcome.tables["emg"] = std::move(table);
}

nlohmann::ordered_json summarizeEmg(const Job& job) {
  const std::optional<NamedActivations> activations = findActivations(job);
  Json comparisons = Json::array();
  for (const EmgComparison& comparison : compareEmgs(job)) {
    comparisons.push_back(summarizeComparison(comparison));
  }
  return {{"channels", summarizeChannels(*job.emg)},
          {"processing", summarizeProcessing(job)},
          {"electromechanical_delay_s", job.settings.emg.electromechanical_delay},
          {"activations_of", activations ? Json(activations->stage) : Json(nullptr)},
          {"cycle_of_foot", "right"},
          {"comparison", comparisons}};
}

}  // namespace gaitmill
