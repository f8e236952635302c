#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace gaitmill {

/// Something that was made and may be asked for again.
struct CachedBytes {
  std::string content_type;
  std::string bytes;
};

/// The latest used of what was put in, up to a number of bytes. Values are shared with whoever
/// still sends them. Safe from any thread.
class ByteCache {
 public:
  using Value = std::shared_ptr<const CachedBytes>;

  /// @param capacity  [bytes] of all values; what is larger by itself is not kept
  explicit ByteCache(std::size_t capacity) : capacity_(capacity) {}

  /// nullptr if it is not there.
  Value find(const std::string& key);
  /// @returns the value, kept or not
  Value put(const std::string& key, CachedBytes value);
  std::size_t size() const;  ///< [bytes]

 private:
  using Entry = std::pair<std::string, Value>;

  void drop(std::list<Entry>::iterator entry);

  std::size_t capacity_;
  mutable std::mutex guard_;
  std::size_t size_ = 0;
  std::list<Entry> entries_;  ///< latest used first
  std::map<std::string, std::list<Entry>::iterator> places_;
};

}  // namespace gaitmill
