#include "core/io/file_content.h"

#include <algorithm>

#include "core/io/number_text.h"

namespace gaitmill {

void requireData(std::string_view bytes, const std::string& file_name) {
  const std::string_view text = trim(skipByteOrderMark(bytes));
  require(!text.empty(), ErrorCode::kFileEmpty, "the file is empty", {file_name, 0, 0, {}});
  const Where start{file_name, 1, 1, {}};
  require(text.substr(0, 26) != "version https://git-lfs.gi",
          ErrorCode::kFileNotTheData,
          "this is a Git LFS pointer, not the data itself; fetch the file with 'git lfs pull'",
          start);
  const bool page = equalsIgnoringCase(text.substr(0, 14), "<!doctype html") ||
                    equalsIgnoringCase(text.substr(0, 5), "<html");
  require(!page,
          ErrorCode::kFileNotTheData,
          "this is a web page, not the data itself; download the raw file",
          start);
}

std::string_view skipByteOrderMark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (bytes.substr(0, kMark.size()) == kMark) {
    bytes.remove_prefix(kMark.size());
  }
  return bytes;
}

Where findWhere(std::string_view bytes, std::size_t offset, const std::string& file_name) {
  offset = std::min(offset, bytes.size());
  Where where{file_name, 1, 1, {}};
  for (std::size_t i = 0; i < offset; ++i) {
    const bool ends_line =
        bytes[i] == '\n' || (bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n'));
    if (ends_line) {
      ++where.line;
      where.column = 1;
    } else {
      ++where.column;
    }
  }
  return where;
}

}  // namespace gaitmill
