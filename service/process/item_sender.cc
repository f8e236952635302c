#include "service/process/item_sender.h"

#include <utility>

namespace gaitmill {

void ItemSender::add(Frame frame) {
  add(std::move(frame), 0, nullptr);
}

void ItemSender::add(Frame announcement, std::uint64_t bytes, ItemReader read) {
  items_.push_back({std::move(announcement), bytes, 0, std::move(read)});
}

std::optional<Frame> ItemSender::next() {
  while (!items_.empty()) {
    Item& item = items_.front();
    if (item.announcement) {
      return std::exchange(item.announcement, std::nullopt);
    }
    if (item.sent < item.size) {
      std::string piece = item.read(item.sent, kPieceSize);
      check(!piece.empty(), "an input ends before its size");
      item.sent += piece.size();
      return makeFrame(Message::kData, {std::move(piece)});
    }
    items_.pop_front();
  }
  return std::nullopt;
}

ItemReader readFromMemory(const std::string& bytes) {
  return [&bytes](std::uint64_t offset, std::size_t size) {
    return bytes.substr(offset, size);
  };
}

}  // namespace gaitmill
