#include "service/process/frames.h"

#include <cstring>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Length = std::uint32_t;
constexpr std::size_t kHeadSize = sizeof(Length) + 1 + sizeof(Length);

void appendLength(std::string& out, std::size_t value) {
  const auto length = static_cast<Length>(value);
  char bytes[sizeof length];
  std::memcpy(bytes, &length, sizeof length);
  out.append(bytes, sizeof length);
}

// Takes numbers and strings off the front of a frame's bytes.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::size_t size) {
    require(size <= rest_.size(), ErrorCode::kJobCrashed, "a message of a child breaks off");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  Length takeLength() {
    Length length = 0;
    std::memcpy(&length, take(sizeof length).data(), sizeof length);
    return length;
  }
  bool isAtEnd() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

Frame decodeBody(std::string_view body) {
  Cursor cursor(body);
  Frame frame;
  frame.kind = static_cast<std::uint8_t>(cursor.take(1).front());
  const Length count = cursor.takeLength();
  for (Length i = 0; i < count; ++i) {
    frame.fields.emplace_back(cursor.take(cursor.takeLength()));
  }
  require(cursor.isAtEnd(), ErrorCode::kJobCrashed, "a message of a child is longer than it says");
  return frame;
}

}  // namespace

std::string encodeFrame(const Frame& frame) {
  std::size_t size = kHeadSize;
  for (const std::string& field : frame.fields) {
    size += sizeof(Length) + field.size();
  }
  check(size <= kMaxFrameBytes, "a message between processes is too long");
  std::string out;
  out.reserve(size);
  appendLength(out, size - sizeof(Length));
  out += static_cast<char>(frame.kind);
  appendLength(out, frame.fields.size());
  for (const std::string& field : frame.fields) {
    appendLength(out, field.size());
    out += field;
  }
  return out;
}

void FrameReader::append(std::string_view bytes) {
  if (begin_ > 0 && begin_ == bytes_.size()) {
    bytes_.clear();
    begin_ = 0;
  }
  bytes_.append(bytes);
}

std::optional<Frame> FrameReader::next() {
  const std::string_view rest = std::string_view(bytes_).substr(begin_);
  if (rest.size() < sizeof(Length)) {
    return std::nullopt;
  }
  const Length length = Cursor(rest).takeLength();
  require(length >= kHeadSize - sizeof(Length) && length <= kMaxFrameBytes,
          ErrorCode::kJobCrashed,
          "a message of a child has an impossible length");
  if (rest.size() < sizeof(Length) + length) {
    return std::nullopt;
  }
  Frame frame = decodeBody(rest.substr(sizeof(Length), length));
  begin_ += sizeof(Length) + length;
  // Taken frames are dropped once they are the larger part, so that the buffer stays small.
  if (begin_ > bytes_.size() / 2) {
    bytes_.erase(0, begin_);
    begin_ = 0;
  }
  return frame;
}

}  // namespace gaitmill
