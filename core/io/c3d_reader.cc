#include "core/io/c3d_reader.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/base/error.h"
#include "core/io/c3d_layout.h"
#include "core/io/c3d_parameters.h"
#include "core/io/c3d_samples.h"
#include "core/io/file_content.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

constexpr char kMagic = 0x50;
constexpr std::size_t kHeaderEvents = 298;  // 12345 here: events in the header have labels
constexpr std::size_t kHeaderEventTimes = 304;
constexpr std::size_t kHeaderEventLabels = 396;
constexpr std::size_t kMostHeaderEvents = 18;
constexpr std::size_t kLastParameterBlock = 31;  // a text file begins with a printable character

/// Byte where the parameter section begins.
std::size_t findParameterSection(std::string_view bytes, const std::string& file_name) {
  const Where where{file_name, 0, 0, {}};
  require(isC3d(bytes), ErrorCode::kC3dHeader, "a C3D file has the byte 0x50 at offset 1", where);
  require(bytes.size() >= 2 * kC3dBlock,
          ErrorCode::kC3dHeader,
          "the file ends within its first two blocks",
          where);
  const auto block = std::max<std::size_t>(static_cast<unsigned char>(bytes[0]), 2);
  const std::size_t begin = (block - 1) * kC3dBlock;
  require(begin + 4 <= bytes.size(),
          ErrorCode::kC3dHeader,
          "the parameter section begins at block " + std::to_string(block) +
              ", which the file does not have",
          where);
  return begin;
}

C3dProcessor findProcessor(std::string_view bytes,
                           std::size_t section,
                           const std::string& file_name) {
  int processor = static_cast<unsigned char>(bytes[section + 3]);
  // Seen without the 83 that the format adds.
  processor += processor >= 1 && processor <= 3 ? 83 : 0;
  require(processor >= 84 && processor <= 86,
          ErrorCode::kC3dHeader,
          "the processor of the file is " + std::to_string(processor) +
              "; 84 (Intel), 85 (DEC) and 86 (MIPS) are known",
          {file_name, 0, 0, "processor"});
  return static_cast<C3dProcessor>(processor);
}

class C3dParser {
 public:
  C3dParser(std::string_view bytes, const std::string& file_name, const C3dOptions& options)
      : section_(findParameterSection(bytes, file_name)),
        bytes_(bytes, findProcessor(bytes, section_, file_name)),
        parameters_(bytes_, section_ + 4, findSectionEnd(), file_.warnings),
        file_name_(file_name),
        options_(options) {}

  C3dFile parse() {
    layout_ = findC3dLayout(bytes_, parameters_, file_name_, file_.warnings);
    readUnits();
    selectMarkers();
    readAnalogScale();
    C3dSamples samples = readC3dSamples(bytes_, layout_, columns_, analog_scale_);
    fillMarkers(samples);
    fillAnalog(samples.analog);
    readEvents();
    return std::move(file_);
  }

 private:
  std::size_t findSectionEnd() const;
  void readUnits();
  void selectMarkers();
  std::unordered_set<std::string> listModelOutputs() const;
  void stripPrefix();
  void readAnalogScale();
  void fillMarkers(C3dSamples& samples);
  void fillAnalog(RowMatrix& analog);
  void readPlates(RowMatrix& analog, std::vector<bool>& plate_channels);
  void copyChannel(const RowMatrix& analog, int channel, Eigen::Index column);
  std::string nameChannel(int channel);
  void readEvents();
  void readHeaderEvents();
  void warn(const std::string& sentence) { file_.warnings.push_back(sentence); }

  C3dFile file_;
  std::size_t section_;
  C3dBytes bytes_;
  C3dParameters parameters_;
  std::string file_name_;
  C3dOptions options_;
  C3dLayout layout_;
  double metres_per_unit_ = 1e-3;
  std::vector<int> columns_;  // points that are markers
  C3dAnalogScale analog_scale_;
  std::vector<std::string> channel_labels_;
  std::vector<std::string> channel_units_;
  std::unordered_set<std::string> known_channels_;
};

// The section states its length in blocks; where that is wrong, the data begin after it.
std::size_t C3dParser::findSectionEnd() const {
  const auto blocks = static_cast<unsigned char>(bytes_.all()[section_ + 2]);
  constexpr std::size_t kDataBlock = 16;
  const std::size_t data =
      kC3dBlock * std::max<std::size_t>(bytes_.word(kDataBlock), 1) - kC3dBlock;
  return std::max(section_ + kC3dBlock * blocks, data);
}

void C3dParser::readUnits() {
  struct Unit {
    const char* name;
    double metres;
  };
  constexpr Unit kUnits[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}};
  const std::string stated = parameters_.findText("POINT", "UNITS");
  file_.units = "mm";
  bool is_known = false;
  for (const Unit& unit : kUnits) {
    if (equalsIgnoringCase(stated, unit.name)) {
      file_.units = unit.name;
      metres_per_unit_ = unit.metres;
      is_known = true;
    }
  }
  if (!is_known) {
    warn("POINT:UNITS is '" + stated + "'; lengths were taken as mm");
  }
  const std::string up = parameters_.findText("POINT", "Y_SCREEN");
  if (up.size() == 2 && (up[0] == '+' || up[0] == '-') && up[1] >= 'X' && up[1] <= 'Z') {
    file_.up = up;
  }
}

std::unordered_set<std::string> C3dParser::listModelOutputs() const {
  std::unordered_set<std::string> outputs;
  for (const char* const kind : {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS"}) {
    for (std::string& name : parameters_.findAllTexts("POINT", kind)) {
      outputs.insert(std::move(name));
    }
  }
  return outputs;
}

void C3dParser::selectMarkers() {
  const std::vector<std::string> labels = parameters_.findAllTexts("POINT", "LABELS");
  const std::unordered_set<std::string> outputs = listModelOutputs();
  std::unordered_set<std::string> known;
  int unlabelled = 0;
  int output_count = 0;
  for (int i = 0; i < layout_.point_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::string label = at < labels.size() ? labels[at] : "";
    if (label.empty() || label[0] == '*') {
      ++unlabelled;
    } else if (outputs.count(label) > 0) {
      ++output_count;
    } else if (!known.insert(label).second) {
      warn("marker '" + label + "' stands twice; the first was kept");
    } else {
      file_.markers.names.push_back(label);
      columns_.push_back(i);
    }
  }
  if (unlabelled > 0) {
    warn(std::to_string(unlabelled) + " points are unlabelled and were left out");
  }
  if (output_count > 0) {
    warn(std::to_string(output_count) +
         " points are outputs of a model (angles, forces, moments, powers, scalars) and were left "
         "out");
  }
  stripPrefix();
}

// "Justin:RASI", of recordings that name their subject. With several subjects the prefix tells
// them apart and stays.
void C3dParser::stripPrefix() {
  std::vector<std::string>& names = file_.markers.names;
  const std::size_t length = names.empty() ? 0 : names[0].find(':') + 1;  // npos + 1 = 0
  if (length == 0) {
    return;
  }
  const std::string prefix = names[0].substr(0, length);
  for (const std::string& name : names) {
    if (name.size() <= length || name.compare(0, length, prefix) != 0) {
      return;
    }
  }
  for (std::string& name : names) {
    name.erase(0, length);
  }
  warn("all markers are named '" + prefix + "...'; the prefix was left out");
}

void C3dParser::readAnalogScale() {
  const auto count = static_cast<std::size_t>(layout_.channel_count);
  if (equalsIgnoringCase(parameters_.findText("ANALOG", "FORMAT"), "UNSIGNED")) {
    analog_scale_.integers = C3dAnalogScale::Integers::kUnsigned;
  }
  const bool is_unsigned = analog_scale_.integers == C3dAnalogScale::Integers::kUnsigned;
  analog_scale_.offset = is_unsigned ? parameters_.findAllNumbers("ANALOG", "OFFSET")
                                     : parameters_.findAllSignedNumbers("ANALOG", "OFFSET");
  analog_scale_.scale = parameters_.findAllNumbers("ANALOG", "SCALE");
  if (count > 0 && analog_scale_.scale.size() < count) {
    warn("ANALOG:SCALE has " + std::to_string(analog_scale_.scale.size()) + " factors for " +
         std::to_string(count) + " channels; the others were taken as 1");
  }
  analog_scale_.offset.resize(count, 0.0);
  analog_scale_.scale.resize(count, 1.0);
  const double general = parameters_.findNumber("ANALOG", "GEN_SCALE").value_or(1.0);
  for (double& scale : analog_scale_.scale) {
    scale *= general;
  }
  channel_labels_ = parameters_.findAllTexts("ANALOG", "LABELS");
  channel_labels_.resize(count);
  channel_units_ = parameters_.findAllTexts("ANALOG", "UNITS");
  channel_units_.resize(count);
}

void C3dParser::fillMarkers(C3dSamples& samples) {
  MarkerTrajectories& markers = file_.markers;
  markers.rate = layout_.rate;
  markers.time.resize(static_cast<std::size_t>(layout_.frame_count));
  for (std::size_t k = 0; k < markers.time.size(); ++k) {
    markers.time[k] = static_cast<double>(k) / layout_.rate;
  }
  markers.positions = std::move(samples.points);
  markers.positions *= metres_per_unit_;
  // Some programs write 0, 0, 0 instead of the residual -1.
  for (std::size_t i = 0; i < samples.zero_counts.size(); ++i) {
    if (samples.zero_counts[i] > 0) {
      warn("marker '" + markers.names[i] + "' is exactly 0, 0, 0 in " +
           std::to_string(samples.zero_counts[i]) + " frames, taken as missing");
    }
  }
  file_.first_frame = layout_.first_frame;
}

void C3dParser::readPlates(RowMatrix& analog, std::vector<bool>& plate_channels) {
  C3dPlateInput input;
  input.metres_per_unit = metres_per_unit_;
  input.channel_units = channel_units_;
  input.subframe_count = layout_.subframe_count;
  input.subtract_baseline = options_.baseline == C3dOptions::Baseline::kSubtract;
  if (!file_.up.empty()) {
    input.up[file_.up[1] - 'X'] = file_.up[0] == '+' ? 1.0 : -1.0;
  }
  C3dPlates plates = readC3dPlates(parameters_, analog, input, file_.warnings);
  file_.plates = std::move(plates.plates);
  file_.ground_reaction.forces = std::move(plates.forces);
  plate_channels = std::move(plates.plate_channels);
}

// A label that is empty or taken gets the channel's number.
std::string C3dParser::nameChannel(int channel) {
  std::string label = channel_labels_[static_cast<std::size_t>(channel)];
  if (label.empty()) {
    label = "channel_" + std::to_string(channel + 1);
  }
  while (!known_channels_.insert(label).second) {
    label += '_' + std::to_string(channel + 1);
  }
  return label;
}

void C3dParser::copyChannel(const RowMatrix& analog, int channel, Eigen::Index column) {
  const std::string& stated = channel_units_[static_cast<std::size_t>(channel)];
  struct Unit {
    const char* name;
    double volts;
  };
  constexpr Unit kVolts[] = {{"V", 1.0}, {"mV", 1e-3}, {"uV", 1e-6}, {"\xC2\xB5V", 1e-6}};
  double factor = 1.0;
  std::string unit = stated;
  for (const Unit& known : kVolts) {
    if (equalsIgnoringCase(stated, known.name)) {
      factor = known.volts;
      unit = "V";
    }
  }
  file_.analog.labels.push_back(nameChannel(channel));
  file_.analog.units.push_back(unit);
  file_.analog.values.col(column) = analog.col(channel) * factor;
}

void C3dParser::fillAnalog(RowMatrix& analog) {
  std::vector<bool> plate_channels;
  readPlates(analog, plate_channels);
  file_.analog_channel_count = layout_.channel_count;
  if (layout_.channel_count == 0) {
    return;
  }
  file_.analog_rate = layout_.rate * layout_.subframe_count;
  std::vector<double> time(static_cast<std::size_t>(analog.rows()));
  for (std::size_t k = 0; k < time.size(); ++k) {
    time[k] = static_cast<double>(k) / file_.analog_rate;
  }
  if (!file_.ground_reaction.forces.empty()) {
    file_.ground_reaction.time = time;
  }
  const auto others = std::count(plate_channels.begin(), plate_channels.end(), false);
  file_.analog.name = "analog";
  if (others == 0) {
    return;
  }
  file_.analog.time = std::move(time);
  file_.analog.values.resize(analog.rows(), others);
  Eigen::Index column = 0;
  for (int channel = 0; channel < layout_.channel_count; ++channel) {
    if (!plate_channels[static_cast<std::size_t>(channel)]) {
      copyChannel(analog, channel, column++);
    }
  }
}

void C3dParser::readHeaderEvents() {
  if (bytes_.word(kHeaderEvents) != 12345) {
    return;
  }
  const auto count = std::min<std::size_t>(bytes_.word(kHeaderEvents + 2), kMostHeaderEvents);
  for (std::size_t i = 0; i < count; ++i) {
    C3dEvent event;
    for (const char c : bytes_.all().substr(kHeaderEventLabels + 4 * i, 4)) {
      event.label += c > ' ' && c <= '~' ? std::string(1, c) : "";
    }
    event.time = static_cast<double>(bytes_.real(kHeaderEventTimes + 4 * i));
    file_.events.push_back(event);
  }
}

void C3dParser::readEvents() {
  const std::vector<double> times = parameters_.findAllNumbers("EVENT", "TIMES");
  const std::vector<std::string> labels = parameters_.findAllTexts("EVENT", "LABELS");
  const std::vector<std::string> contexts = parameters_.findAllTexts("EVENT", "CONTEXTS");
  const double used = parameters_.findNumber("EVENT", "USED").value_or(65535.0);
  // Pairs of minutes and seconds.
  for (std::size_t i = 0; 2 * i + 1 < times.size() && static_cast<double>(i) < used; ++i) {
    file_.events.push_back({i < labels.size() ? labels[i] : "",
                            i < contexts.size() ? contexts[i] : "",
                            60.0 * times[2 * i] + times[2 * i + 1]});
  }
  if (file_.events.empty()) {
    readHeaderEvents();
  }
  std::vector<C3dEvent>& events = file_.events;
  const auto end = std::remove_if(events.begin(), events.end(), [](const C3dEvent& event) {
    return !std::isfinite(event.time);
  });
  if (end != events.end()) {
    warn(std::to_string(events.end() - end) + " events have no time and were left out");
    events.erase(end, events.end());
  }
  // Events count from the first frame of the recording, not of the part that the file holds.
  const double start = static_cast<double>(layout_.first_frame - 1) / layout_.rate;
  for (C3dEvent& event : events) {
    event.time -= start;
  }
  std::stable_sort(events.begin(), events.end(), [](const C3dEvent& a, const C3dEvent& b) {
    return a.time < b.time;
  });
}

}  // namespace

bool isC3d(std::string_view bytes) {
  return bytes.size() >= 2 && bytes[1] == kMagic &&
         static_cast<unsigned char>(bytes[0]) <= kLastParameterBlock;
}

C3dFile readC3d(std::string_view bytes, const std::string& file_name, const C3dOptions& options) {
  requireData(bytes, file_name);
  return C3dParser(bytes, file_name, options).parse();
}

}  // namespace gaitmill
