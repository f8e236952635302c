#include "tests/support/c3d_writer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gaitmill {

namespace {

constexpr std::size_t kBlock = 512;

void padToBlock(std::string& bytes) {
  bytes.resize((bytes.size() + kBlock - 1) / kBlock * kBlock, '\0');
}

}  // namespace

void C3dWriter::putWord(std::string& bytes, long value) const {
  const auto word = static_cast<std::uint16_t>(value);
  const char low = static_cast<char>(word & 0xFFU);
  const char high = static_cast<char>(word >> 8U);
  bytes += processor == Processor::kMips ? std::string{high, low} : std::string{low, high};
}

void C3dWriter::putReal(std::string& bytes, double value) const {
  const auto real = static_cast<float>(processor == Processor::kDec ? 4.0 * value : value);
  std::uint32_t bits;
  std::memcpy(&bits, &real, sizeof bits);
  const auto high = static_cast<long>(bits >> 16U);
  const auto low = static_cast<long>(bits & 0xFFFFU);
  putWord(bytes, processor == Processor::kIntel ? low : high);
  putWord(bytes, processor == Processor::kIntel ? high : low);
}

void C3dWriter::putSample(std::string& bytes, double value) const {
  if (is_real) {
    putReal(bytes, value);
  } else {
    putWord(bytes, std::lround(value));
  }
}

void C3dWriter::addTexts(const std::string& group,
                         const std::string& name,
                         const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) {
    length = std::max(length, text.size());
  }
  std::string data;
  for (const std::string& text : texts) {
    data += text + std::string(length - text.size(), ' ');
  }
  parameters_.push_back(
      {group, name, -1, {static_cast<int>(length), static_cast<int>(texts.size())}, data, {}});
}

void C3dWriter::addWords(const std::string& group,
                         const std::string& name,
                         const std::vector<int>& dimensions,
                         const std::vector<int>& values) {
  parameters_.push_back({group, name, 2, dimensions, "", {values.begin(), values.end()}});
}

void C3dWriter::addReals(const std::string& group,
                         const std::string& name,
                         const std::vector<int>& dimensions,
                         const std::vector<double>& values) {
  parameters_.push_back({group, name, 4, dimensions, "", values});
}

void C3dWriter::addPointGroup(const std::vector<std::string>& labels) {
  addWords("POINT", "USED", {}, {static_cast<int>(points.empty() ? 0 : points[0].size() / 4)});
  addReals("POINT", "SCALE", {}, {is_real ? -point_scale : point_scale});
  addReals("POINT", "RATE", {}, {rate});
  addTexts("POINT", "UNITS", {"mm"});
  for (std::size_t i = 0; i < labels.size(); i += 255) {
    const std::string name = i == 0 ? "LABELS" : "LABELS" + std::to_string(i / 255 + 1);
    const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(i);
    const auto count = static_cast<std::ptrdiff_t>(std::min<std::size_t>(255, labels.size() - i));
    addTexts("POINT", name, {begin, begin + count});
  }
}

void C3dWriter::addAnalogGroup(const std::vector<std::string>& labels,
                               const std::vector<std::string>& units) {
  const auto count = analog.empty() ? 0 : analog[0].size();
  addWords("ANALOG", "USED", {}, {static_cast<int>(count)});
  addReals("ANALOG", "RATE", {}, {rate * subframes});
  addReals("ANALOG", "GEN_SCALE", {}, {1.0});
  const int stated = static_cast<int>(std::min<std::size_t>(count, 255));
  addReals("ANALOG", "SCALE", {stated}, std::vector<double>(static_cast<std::size_t>(stated), 1.0));
  addWords("ANALOG", "OFFSET", {stated}, std::vector<int>(static_cast<std::size_t>(stated), 0));
  for (std::size_t i = 0; i < labels.size(); i += 255) {
    const std::string name = i == 0 ? "LABELS" : "LABELS" + std::to_string(i / 255 + 1);
    const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(i);
    const auto size = static_cast<std::ptrdiff_t>(std::min<std::size_t>(255, labels.size() - i));
    addTexts("ANALOG", name, {begin, begin + size});
  }
  addTexts("ANALOG", "UNITS", units);
}

void C3dWriter::addPlate(int type,
                         const std::vector<double>& corners,
                         const std::vector<double>& origin,
                         int channel_count) {
  std::vector<int> channels;
  for (int i = 1; i <= channel_count; ++i) {
    channels.push_back(i);
  }
  addWords("FORCE_PLATFORM", "USED", {}, {1});
  addWords("FORCE_PLATFORM", "TYPE", {1}, {type});
  addReals("FORCE_PLATFORM", "CORNERS", {3, 4, 1}, corners);
  addReals("FORCE_PLATFORM", "ORIGIN", {3, 1}, origin);
  addWords("FORCE_PLATFORM", "CHANNEL", {channel_count, 1}, channels);
}

void C3dWriter::beginRecord(std::string& bytes, int id, const std::string& name) const {
  bytes += static_cast<char>(name.size());
  bytes += static_cast<char>(id);
  bytes += name;
}

std::string C3dWriter::writeParameters() const {
  std::string bytes(4, '\0');
  std::vector<std::string> groups;
  for (const Parameter& parameter : parameters_) {
    auto group = std::find(groups.begin(), groups.end(), parameter.group);
    if (group == groups.end()) {
      group = groups.insert(groups.end(), parameter.group);
    }
    std::string body;
    body += static_cast<char>(parameter.type);
    body += static_cast<char>(parameter.dimensions.size());
    for (const int dimension : parameter.dimensions) {
      body += static_cast<char>(dimension);
    }
    body += parameter.text;
    for (const double number : parameter.numbers) {
      if (parameter.type == 2) {
        putWord(body, std::lround(number));
      } else {
        putReal(body, number);
      }
    }
    body += '\0';  // no description
    beginRecord(bytes, static_cast<int>(group - groups.begin()) + 1, parameter.name);
    putWord(bytes, static_cast<long>(body.size()) + 2);
    bytes += body;
  }
  // Groups after their parameters, as some programs have them.
  for (std::size_t i = 0; i < groups.size(); ++i) {
    beginRecord(bytes, -static_cast<int>(i) - 1, groups[i]);
    putWord(bytes, i + 1 == groups.size() ? 0 : 3);
    bytes += '\0';
  }
  padToBlock(bytes);
  bytes[0] = 1;
  bytes[1] = 0x50;
  bytes[2] = static_cast<char>(bytes.size() / kBlock);
  bytes[3] = static_cast<char>(processor);
  return bytes;
}

std::string C3dWriter::write() const {
  const std::string parameters = writeParameters();
  const auto frames = static_cast<int>(
      points.empty() ? analog.size() / static_cast<std::size_t>(subframes) : points.size());
  const int point_count = static_cast<int>(points.empty() ? 0 : points[0].size() / 4);
  const int samples = static_cast<int>(analog.empty() ? 0 : analog[0].size()) * subframes;
  std::string header = {2, 0x50};
  putWord(header, header_points >= 0 ? header_points : point_count);
  putWord(header, header_samples >= 0 ? header_samples : samples);
  putWord(header, first_frame);
  putWord(header, header_last_frame >= 0 ? header_last_frame : first_frame + frames - 1);
  putWord(header, 10);
  putReal(header, is_real ? -point_scale : point_scale);
  putWord(header, static_cast<long>(2 + parameters.size() / kBlock));
  putWord(header, header_subframes >= 0 ? header_subframes : subframes);
  putReal(header, rate);
  header.resize(kBlock, '\0');
  std::string data;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frames); ++k) {
    if (!points.empty()) {
      for (std::size_t i = 0; i < points[k].size(); ++i) {
        const bool is_length = i % 4 != 3;
        putSample(data, is_length && !is_real ? points[k][i] / point_scale : points[k][i]);
      }
    }
    for (std::size_t s = 0; !analog.empty() && s < static_cast<std::size_t>(subframes); ++s) {
      for (const double value : analog[k * static_cast<std::size_t>(subframes) + s]) {
        putSample(data, value);
      }
    }
  }
  padToBlock(data);
  return header + parameters + data;
}

}  // namespace gaitmill
