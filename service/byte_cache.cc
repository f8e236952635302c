#include "service/byte_cache.h"

#include <iterator>

namespace gaitmill {

namespace {

// Keys and the list's own nodes count too, so that many small values stay bounded.
constexpr std::size_t kOverhead = 256;  // [bytes]

std::size_t sizeOf(const std::string& key, const CachedBytes& value) {
  return kOverhead + key.size() + value.content_type.size() + value.bytes.size();
}

}  // namespace

ByteCache::Value ByteCache::find(const std::string& key) {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto place = places_.find(key);
  if (place == places_.end()) {
    return nullptr;
  }
  entries_.splice(entries_.begin(), entries_, place->second);
  return place->second->second;
}

ByteCache::Value ByteCache::put(const std::string& key, CachedBytes value) {
  const Value kept = std::make_shared<const CachedBytes>(std::move(value));
  const std::size_t size = sizeOf(key, *kept);
  const std::lock_guard<std::mutex> lock(guard_);
  const auto place = places_.find(key);
  if (place != places_.end()) {
    drop(place->second);
  }
  if (size > capacity_) {
    return kept;
  }
  while (size_ + size > capacity_) {
    drop(std::prev(entries_.end()));
  }
  entries_.emplace_front(key, kept);
  places_[key] = entries_.begin();
  size_ += size;
  return kept;
}

std::size_t ByteCache::size() const {
  const std::lock_guard<std::mutex> lock(guard_);
  return size_;
}

void ByteCache::drop(std::list<Entry>::iterator entry) {
  size_ -= sizeOf(entry->first, *entry->second);
  places_.erase(entry->first);
  entries_.erase(entry);
}

}  // namespace gaitmill
