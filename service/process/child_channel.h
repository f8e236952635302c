#pragma once

#include "service/process/frames.h"
#include "service/process/item_sender.h"

namespace gaitmill {

/// The child's end of the channel. Both directions block; when the service has gone, the process
/// ends, because nobody wants its results.
class ChildChannel {
 public:
  explicit ChildChannel(int fd) : fd_(fd) {}

  void send(const Frame& frame);
  /// Announcement and bytes.
  void sendItem(Frame announcement, const std::string& bytes);
  Frame receive();

 private:
  int fd_;
  FrameReader reader_;
};

}  // namespace gaitmill
