#include <algorithm>
#include <utility>

#include "api/http.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

class StringSource : public ByteSource {
 public:
  explicit StringSource(std::string bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    return offset < bytes_.size() ? bytes_.substr(static_cast<std::size_t>(offset), size) : "";
  }

 private:
  std::string bytes_;
};

class Slice : public ByteSource {
 public:
  Slice(std::shared_ptr<const ByteSource> whole, std::uint64_t offset, std::uint64_t size)
      : whole_(std::move(whole)), offset_(offset), size_(size) {}

  std::uint64_t size() const override { return size_; }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    if (offset >= size_) {
      return "";
    }
    const std::uint64_t count = std::min<std::uint64_t>(size, size_ - offset);
    return whole_->read(offset_ + offset, static_cast<std::size_t>(count));
  }

 private:
  std::shared_ptr<const ByteSource> whole_;
  std::uint64_t offset_;
  std::uint64_t size_;
};

}  // namespace

std::shared_ptr<const ByteSource> makeByteSource(std::string bytes) {
  return std::make_shared<StringSource>(std::move(bytes));
}

std::shared_ptr<const ByteSource> makeSlice(std::shared_ptr<const ByteSource> whole,
                                            std::uint64_t offset,
                                            std::uint64_t size) {
  const std::uint64_t begin = std::min(offset, whole->size());
  const std::uint64_t count = std::min(size, whole->size() - begin);
  return std::make_shared<Slice>(std::move(whole), begin, count);
}

std::string readAll(const ByteSource& source, std::uint64_t limit) {
  require(source.size() <= limit,
          ErrorCode::kRequestTooLarge,
          std::to_string(source.size()) + " bytes, " + std::to_string(limit) + " are allowed",
          {"", 0, 0, "body"});
  std::string all;
  all.reserve(static_cast<std::size_t>(source.size()));
  while (all.size() < source.size()) {
    const std::string piece =
        source.read(all.size(), static_cast<std::size_t>(source.size()) - all.size());
    check(!piece.empty(), "a byte source ends before its size");
    all += piece;
  }
  return all;
}

const std::string& HttpRequest::header(const std::string& lower_case_name) const {
  static const std::string kAbsent;
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? kAbsent : found->second;
}

}  // namespace gaitmill::api
