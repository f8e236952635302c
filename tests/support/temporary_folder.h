#pragma once

#include <string>

namespace gaitmill {

/// A new empty folder, removed with everything in it when this goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Creates missing folders too.
  void write(const std::string& name, const std::string& bytes) const;

 private:
  std::string path_;
};

}  // namespace gaitmill
