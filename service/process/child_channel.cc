#include "service/process/child_channel.h"

#include <sys/socket.h>
#include <sys/types.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

namespace gaitmill {

void ChildChannel::send(const Frame& frame) {
  const std::string bytes = encodeFrame(frame);
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t size = ::send(fd_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (size > 0) {
      rest.remove_prefix(static_cast<std::size_t>(size));
    } else if (errno != EINTR) {
      std::_Exit(EXIT_FAILURE);
    }
  }
}

void ChildChannel::sendItem(Frame announcement, const std::string& bytes) {
  ItemSender sender;
  sender.add(std::move(announcement), bytes.size(), readFromMemory(bytes));
  while (const std::optional<Frame> frame = sender.next()) {
    send(*frame);
  }
}

Frame ChildChannel::receive() {
  std::array<char, 1U << 16U> buffer{};
  while (true) {
    if (std::optional<Frame> frame = reader_.next()) {
      return std::move(*frame);
    }
    const ssize_t size = ::recv(fd_, buffer.data(), buffer.size(), 0);
    if (size > 0) {
      reader_.append({buffer.data(), static_cast<std::size_t>(size)});
    } else if (size == 0 || errno != EINTR) {
      std::_Exit(EXIT_FAILURE);
    }
  }
}

}  // namespace gaitmill
