#include "service/unlinked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// Not every file system knows files without a name; then one is made and unlinked at once.
int openUnlinked(const std::string& folder) {
  const int nameless = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (nameless >= 0) {
    return nameless;
  }
  std::string path = folder + "/spool-XXXXXX";
  const int named = ::mkostemp(path.data(), O_CLOEXEC);
  if (named >= 0) {
    ::unlink(path.c_str());
  }
  return named;
}

}  // namespace

UnlinkedFile::UnlinkedFile(const std::string& folder) : descriptor_(openUnlinked(folder)) {
  require(descriptor_ >= 0,
          ErrorCode::kStorage,
          "no temporary file can be made in '" + folder + "'",
          {folder});
}

UnlinkedFile::~UnlinkedFile() {
  ::close(descriptor_);
}

std::uint64_t UnlinkedFile::size() const {
  struct stat status {};
  require(::fstat(descriptor_, &status) == 0, ErrorCode::kStorage, "a temporary file is lost");
  return static_cast<std::uint64_t>(status.st_size);
}

std::string UnlinkedFile::read(std::uint64_t offset, std::size_t size) const {
  const std::uint64_t end = this->size();
  const std::uint64_t left = offset < end ? end - offset : 0;
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size, left)), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::pread(
        descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    require(count > 0 || (count < 0 && errno == EINTR),
            ErrorCode::kStorage,
            "a temporary file cannot be read");
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  return bytes;
}

}  // namespace gaitmill
