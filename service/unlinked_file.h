#pragma once

#include <cstdint>
#include <string>

#include "api/http.h"

namespace gaitmill {

/// A file without a name, for bytes that are too many for memory: gone when the object goes, also
/// if the process is killed. Written once from its start, then read.
class UnlinkedFile : public api::ByteSource {
 public:
  /// @param folder  on whose file system the bytes lie. @throws Error kStorage
  explicit UnlinkedFile(const std::string& folder);
  ~UnlinkedFile() override;
  UnlinkedFile(const UnlinkedFile&) = delete;
  UnlinkedFile& operator=(const UnlinkedFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint64_t size() const override;
  std::string read(std::uint64_t offset, std::size_t size) const override;

 private:
  int descriptor_ = -1;
};

}  // namespace gaitmill
