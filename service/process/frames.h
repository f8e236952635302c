#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// One message between the service and a child process: what it is and its byte strings.
struct Frame {
  std::uint8_t kind = 0;
  std::vector<std::string> fields;
};

/// Larger messages do not exist: long byte strings travel in pieces. [bytes]
inline constexpr std::size_t kMaxFrameBytes = 64U << 20U;

/// On the wire, in the machine's own byte order since both ends are one program: the length of what
/// follows (4 bytes), the kind (1), the number of fields (4), then every field as length (4) and
/// bytes.
/// @throws Error kInternal if it would have more than kMaxFrameBytes
std::string encodeFrame(const Frame& frame);

/// Cuts a stream of bytes into frames. What the other side sends is not trusted: a length that
/// cannot be is refused before anything is allocated for it.
class FrameReader {
 public:
  void append(std::string_view bytes);
  /// The next complete frame, or nothing yet. @throws Error kJobCrashed if the bytes are no frame
  std::optional<Frame> next();

 private:
  std::string bytes_;
  std::size_t begin_ = 0;  ///< of the first frame that has not been taken
};

}  // namespace gaitmill
