#include "service/storage/table_codec.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
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

TimeSeries decodeTable(const std::string& bytes) {
  std::uint64_t header_size = 0;
  const bool has_preamble =
      bytes.size() >= kPreambleSize && bytes.compare(0, kMagicSize, kMagic) == 0;
  require(has_preamble, ErrorCode::kStorage, "a stored table is damaged: it has no header");
  std::memcpy(&header_size, &bytes[kMagicSize], sizeof header_size);
  require(header_size <= bytes.size() - kPreambleSize,
          ErrorCode::kStorage,
          "a stored table is damaged: its header breaks off");
  const auto header = nlohmann::json::parse(bytes.substr(kPreambleSize, header_size));
  TimeSeries table = makeTimeSeries(header.at("name"),
                                    header.at("labels").get<std::vector<std::string>>(),
                                    std::vector<double>(header.at("rows").get<std::size_t>()));
  table.units = header.at("units").get<std::vector<std::string>>();
  const std::size_t begin = kPreambleSize + header_size;
  const std::size_t time_size = table.time.size() * sizeof(double);
  const std::size_t values_size = sizeOfValues(table) * sizeof(double);
  require(bytes.size() == begin + time_size + values_size,
          ErrorCode::kStorage,
          "a stored table is damaged: its size does not fit its header");
  if (time_size > 0) {
    std::memcpy(table.time.data(), bytes.data() + begin, time_size);
  }
  if (values_size > 0) {
    std::memcpy(table.values.data(), bytes.data() + begin + time_size, values_size);
  }
  return table;
}

}  // namespace gaitmill
