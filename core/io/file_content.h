#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"

namespace gaitmill {

/// Refuses bytes that are not a data file of any kind: nothing at all, a Git LFS pointer that was
/// never resolved, or a web page saved under the file's name.
/// @throws Error kFileEmpty, kFileNotTheData
void requireData(std::string_view bytes, const std::string& file_name);

/// `bytes` without a UTF-8 byte-order mark.
std::string_view skipByteOrderMark(std::string_view bytes);

/// Line and column of a byte, both from 1; a tab is one column; \r\n, \n and lone \r end lines.
Where findWhere(std::string_view bytes, std::size_t offset, const std::string& file_name);

}  // namespace gaitmill
