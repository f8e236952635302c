#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "service/process/messages.h"

namespace gaitmill {

/// Bytes [offset, offset + size) of an item.
using ItemReader = std::function<std::string(std::uint64_t offset, std::size_t size)>;

/// Messages to send one after the other; an item's bytes are read only when their turn comes.
class ItemSender {
 public:
  void add(Frame frame);
  /// @param bytes  [bytes] that `read` can give
  void add(Frame announcement, std::uint64_t bytes, ItemReader read);
  /// The next message, nothing when all have been taken.
  std::optional<Frame> next();

 private:
  struct Item {
    std::optional<Frame> announcement;
    std::uint64_t size = 0;
    std::uint64_t sent = 0;
    ItemReader read;
  };
  std::deque<Item> items_;
};

/// A reader of bytes in memory, which must outlive it.
ItemReader readFromMemory(const std::string& bytes);

}  // namespace gaitmill
