// Figures of activations beside electromyograms.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/figure/job_builders.h"
#include "core/figure/muscle_names.h"

namespace gaitmill {

namespace {

using Json = nlohmann::json;

/// A channel of the electromyogram and the muscles that it is held against.
struct Channel {
  std::string name;  ///< column of the table "emg"
  std::vector<std::string> muscles;
};

std::vector<Channel> readChannels(const JobData& data) {
  std::vector<Channel> channels;
  const Json::json_pointer place("/emg/channels");
  if (!data.summary().contains(place)) {
    return channels;
  }
  for (const Json& entry : data.summary().at(place)) {
    Channel channel{entry.value("channel", ""), {}};
    for (const Json& muscle : entry.value("muscles", Json::array())) {
      if (muscle.is_string() && data.has("activations", muscle.get<std::string>())) {
        channel.muscles.push_back(muscle.get<std::string>());
      }
    }
    if (!channel.muscles.empty() && data.has("emg", channel.name)) {
      channels.push_back(channel);
    }
  }
  return channels;
}

/// Mean activation of muscles, as column "mean".
TimeSeries calcMeanActivation(const TimeSeries& activations,
                              const std::vector<std::string>& muscles) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(activations.rowCount());
  for (const std::string& muscle : muscles) {
    sum += activations.values.col(activations.getColumn(muscle));
  }
  TimeSeries table = makeEmptyTable(activations);
  addColumn("mean", sum / static_cast<double>(muscles.size()), table);
  return table;
}

/// The rows of the electromyogram at which there are activations, and one more at each end: what is
/// shown of both is the same stretch of the trial, realigned alike.
TimeSeries cutToActivations(const TimeSeries& emg, const TimeSeries& activations) {
  int first = emg.findNearestRow(activations.time.front());
  int last = emg.findNearestRow(activations.time.back());
  first = std::max(0, first - 1);
  last = std::min(emg.rowCount() - 1, last + 1);
  return emg.copyRows(first, last);
}

double findPeak(const Panel& panel, SeriesRole role) {
  double peak = std::numeric_limits<double>::quiet_NaN();
  for (const Series& series : panel.series) {
    for (const double value : series.y) {
      if (series.role == role && series.mark == SeriesMark::kLine) {
        peak = std::fmax(peak, value);
      }
    }
  }
  return peak;
}

/// Scales the electromyogram so that it peaks where the activation does, over what is shown.
void scaleToActivation(Panel& panel) {
  const double factor = findPeak(panel, SeriesRole::kSimulated) / findPeak(panel, SeriesRole::kEmg);
  if (!std::isfinite(factor)) {
    return;
  }
  for (Series& series : panel.series) {
    if (series.role == SeriesRole::kEmg) {
      std::transform(
          series.y.begin(), series.y.end(), series.y.begin(), [&](double y) { return factor * y; });
      std::transform(series.low.begin(), series.low.end(), series.low.begin(), [&](double y) {
        return factor * y;
      });
    }
  }
}

/// "in agreement 85 % of the cycle, correlation 0.93 at a lag of 2 %"; empty if nothing is known.
std::string describeAgreement(const JobData& data, const std::string& channel) {
  const Json::json_pointer place("/emg/comparison");
  if (!data.summary().contains(place)) {
    return "";
  }
  for (const Json& entry : data.summary().at(place)) {
    const Json overlap = entry.value("overlap", Json());
    const Json correlation = entry.value("correlation", Json());
    const Json lag = entry.value("lag_percent", Json());
    if (entry.value("channel", "") == channel && overlap.is_number() && correlation.is_number() &&
        lag.is_number()) {
      return "on and off alike " + formatShort(100 * overlap.get<double>()) +
             " % of the cycle; correlation " + formatFixed(correlation.get<double>(), 2) +
             " at a lag of " + formatShort(lag.get<double>()) + " %";
    }
  }
  return "";
}

Panel makeChannelPanel(const JobData& data, const Channel& channel, const std::string& title) {
  const Side side = splitSide(channel.muscles.front()).side;
  const TimeSeries& activations = data.table("activations");
  Panel panel = makePanel(
      data, channel.name.empty() ? title : channel.name, title, {"Activation", "", 0.0, 1.0});
  if (!channel.name.empty()) {
    data.addCurve(cutToActivations(data.table("emg"), activations),
                  channel.name,
                  side,
                  {"electromyogram, scaled", SeriesRole::kEmg, 1},
                  panel);
  }
  data.addCurve(calcMeanActivation(activations, channel.muscles),
                "mean",
                side,
                {"simulated activation", SeriesRole::kSimulated, 1},
                panel);
  scaleToActivation(panel);
  data.addToeOffs(side != Side::kLeft, side == Side::kLeft, panel);
  panel.note = describeAgreement(data, channel.name);
  return panel;
}

/// "Soleus, right"; "Gluteus maximus, right" for the mean of its parts; "Semimembranosus,
/// semitendinosus, right".
std::string nameMuscles(const std::vector<std::string>& muscles) {
  std::string names;
  for (const std::string& muscle : muscles) {
    std::string name = findMuscleName(splitSide(muscle).base).display;
    if (muscles.size() > 1) {
      name = name.substr(0, name.find(','));
    }
    if (names.empty()) {
      names = name;
      continue;
    }
    name.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
    // Parts of one muscle follow each other.
    const bool is_part =
        names.size() >= name.size() &&
        names.compare(names.size() - name.size() + 1, name.size() - 1, name, 1, name.size() - 1) ==
            0;
    names += is_part ? "" : ", " + name;
  }
  const std::string side = sideWord(splitSide(muscles.front()).side);
  return side.empty() ? names : names + ", " + side;
}

std::string describeEmg(const JobData& data, bool has_left) {
  std::string sentence =
      " Each electromyogram is scaled to the peak of the activation over what is shown "
      "(Rajagopal et al. 2016).";
  const Json::json_pointer place("/emg/electromechanical_delay_s");
  const Json delay = data.summary().contains(place) ? data.summary().at(place) : Json();
  if (delay.is_number() && delay.get<double>() != 0) {
    sentence += " It is shown " + formatShort(1000 * delay.get<double>()) +
                " ms later than recorded, the electromechanical delay.";
  } else {
    sentence += " No electromechanical delay is taken into account.";
  }
  return sentence + " " + data.describeAxis(has_left);
}

/// The eight of the paper, right leg; the first muscle finds the channel.
struct PaperGroup {
  const char* title;
  std::vector<std::string> muscles;
};

const std::vector<PaperGroup>& paperGroups() {
  static const std::vector<PaperGroup> groups = {
      {"Gluteus maximus", {"glmax1_r", "glmax2_r", "glmax3_r"}},
      {"Gluteus medius", {"glmed1_r", "glmed2_r", "glmed3_r"}},
      {"Rectus femoris", {"recfem_r"}},
      {"Vastus lateralis", {"vaslat_r"}},
      {"Biceps femoris, long head", {"bflh_r"}},
      {"Gastrocnemius, lateral", {"gaslat_r"}},
      {"Tibialis anterior", {"tibant_r"}},
      {"Soleus", {"soleus_r"}}};
  return groups;
}

std::string findChannel(const std::vector<Channel>& channels, const std::string& muscle) {
  for (const Channel& channel : channels) {
    if (std::find(channel.muscles.begin(), channel.muscles.end(), muscle) !=
        channel.muscles.end()) {
      return channel.name;
    }
  }
  return "";
}

}  // namespace

void buildActivationsEmg(const JobData& data, Figure& figure) {
  for (const Channel& channel : readChannels(data)) {
    Panel panel = makeChannelPanel(data, channel, nameMuscles(channel.muscles));
    panel.title += " (" + channel.name + ")";
    figure.panels.push_back(std::move(panel));
  }
  figure.caption += describeEmg(data, true);
}

void buildPaperFigure5(const JobData& data, Figure& figure) {
  const std::vector<Channel> channels = readChannels(data);
  for (const PaperGroup& group : paperGroups()) {
    std::vector<std::string> muscles;
    for (const std::string& muscle : group.muscles) {
      if (data.has("activations", muscle)) {
        muscles.push_back(muscle);
      }
    }
    if (!muscles.empty()) {
      figure.panels.push_back(
          makeChannelPanel(data, {findChannel(channels, muscles.front()), muscles}, group.title));
    }
  }
  figure.caption += describeEmg(data, false);
}

}  // namespace gaitmill
