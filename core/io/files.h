#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// Largest file that readFile takes: some ten times the biggest trial seen (a 14 MB force file).
inline constexpr std::size_t kMaximumFileSize = std::size_t{256} << 20;

/// All bytes of a file. @throws Error kFileNotFound, kFileUnreadable (also for folders),
/// kFileTooLarge, kFileEmpty, kFileNotTheData (Git LFS pointer or web page instead of the data)
std::string readFile(const std::string& path, std::size_t maximum_size = kMaximumFileSize);

/// Paths of the files in a folder whose names end so, sorted; empty if there is no such folder.
std::vector<std::string> listFiles(const std::string& folder, std::string_view ending);

/// Replaces the file in one step: readers see the old content or the new, never a part. Creates
/// missing folders. @throws Error kFileUnwritable
void writeFile(const std::string& path, std::string_view bytes);

}  // namespace gaitmill
