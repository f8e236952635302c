#include "service/storage/table_codec.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr const char* kMagic = "GMT1";
constexpr std::size_t kMagicSize = 4;
constexpr std::size_t kPreambleSize = kMagicSize + sizeof(std::uint64_t);

void appendDoubles(std::string& out, const double* values, std::size_t count) {
  const std::size_t begin = out.size();
  out.resize(begin + count * sizeof(double));
  if (count > 0) {
    std::memcpy(&out[begin], values, count * sizeof(double));
  }
}

std::size_t sizeOfValues(const TimeSeries& table) {
  return static_cast<std::size_t>(table.values.size());
}

}  // namespace

std::string encodeTable(const TimeSeries& table) {
  const std::string header = api::dumpJson({{"name", table.name},
                                            {"labels", table.labels},
                                            {"units", table.units},
                                            {"rows", table.time.size()}});
  const std::uint64_t header_size = header.size();
  std::string out(kMagic, kMagicSize);
  out.append(sizeof header_size, '\0');
  std::memcpy(&out[kMagicSize], &header_size, sizeof header_size);
  out += header;
  appendDoubles(out, table.time.data(), table.time.size());
  appendDoubles(out, table.values.data(), sizeOfValues(table));
  return out;
}

namespace {

struct Header {
  std::string name;
  std::vector<std::string> labels;
  std::vector<std::string> units;
  std::uint64_t rows = 0;
};

std::uint64_t readCount(const nlohmann::json& value) {
  require(value.is_number_unsigned(),
          ErrorCode::kStorage,
          "a stored table is damaged: its number of rows is none");
  return value.get<std::uint64_t>();
}

Header readHeader(std::string_view text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    return {json.at("name").get<std::string>(),
            json.at("labels").get<std::vector<std::string>>(),
            json.at("units").get<std::vector<std::string>>(),
            readCount(json.at("rows"))};
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorCode::kStorage, "a stored table is damaged: its header cannot be read");
  }
}

}  // namespace

TimeSeries decodeTable(const std::string& bytes) {
  std::uint64_t header_size = 0;
  const bool has_preamble =
      bytes.size() >= kPreambleSize && bytes.compare(0, kMagicSize, kMagic) == 0;
  require(has_preamble, ErrorCode::kStorage, "a stored table is damaged: it has no header");
  std::memcpy(&header_size, &bytes[kMagicSize], sizeof header_size);
  require(header_size <= bytes.size() - kPreambleSize,
          ErrorCode::kStorage,
          "a stored table is damaged: its header breaks off");
  Header header = readHeader(std::string_view(bytes).substr(kPreambleSize, header_size));
  const std::size_t begin = kPreambleSize + header_size;
  const std::uint64_t cells = (bytes.size() - begin) / sizeof(double);
  // Compared before anything is allocated; rows <= cells keeps the product from overflowing.
  require(header.rows <= cells && header.rows * (header.labels.size() + 1) == cells &&
              (bytes.size() - begin) % sizeof(double) == 0 &&
              (header.units.empty() || header.units.size() == header.labels.size()),
          ErrorCode::kStorage,
          "a stored table is damaged: its size does not fit its header");
  TimeSeries table = makeTimeSeries(
      std::move(header.name), std::move(header.labels), std::vector<double>(header.rows));
  table.units = std::move(header.units);
  const std::size_t time_size = table.time.size() * sizeof(double);
  const std::size_t values_size = sizeOfValues(table) * sizeof(double);
  if (time_size > 0) {
    std::memcpy(table.time.data(), bytes.data() + begin, time_size);
  }
  if (values_size > 0) {
    std::memcpy(table.values.data(), bytes.data() + begin + time_size, values_size);
  }
  return table;
}

}  // namespace gaitmill
