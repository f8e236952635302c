#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace gaitmill {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void update(std::string_view bytes);
  /// 64 lower-case hex digits. Call once.
  std::string finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// SHA-256 of the bytes as 64 lower-case hex digits.
std::string calcSha256(std::string_view bytes);

}  // namespace gaitmill
