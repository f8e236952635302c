#include "service/storage/ids.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <random>

#include "service/storage/clock.h"

namespace gaitmill {

namespace {

constexpr std::array<char, 33> kAlphabet = {"0123456789abcdefghjkmnpqrstvwxyz"};
constexpr int kTimeLetters = 10;    // 50 bits, the upper two zero
constexpr int kRandomLetters = 16;  // 80 bits

struct Stamp {
  std::uint64_t time = 0;
  std::array<std::uint32_t, kRandomLetters> random{};  // one base-32 digit each
};

void drawRandom(Stamp& stamp) {
  static std::random_device source;
  for (std::uint32_t& digit : stamp.random) {
    digit = source() % 32U;
  }
}

void increment(Stamp& stamp) {
  for (std::size_t i = stamp.random.size(); i-- > 0;) {
    stamp.random[i] = (stamp.random[i] + 1) % 32U;
    if (stamp.random[i] != 0) {
      return;
    }
  }
}

Stamp nextStamp() {
  static std::mutex guard;
  static Stamp last;
  const std::lock_guard<std::mutex> lock(guard);
  const auto now = static_cast<std::uint64_t>(nowMilliseconds());
  if (now > last.time) {
    last.time = now;
    drawRandom(last);
  } else {
    increment(last);
  }
  return last;
}

}  // namespace

std::string makeId(const std::string& prefix) {
  const Stamp stamp = nextStamp();
  std::string id = prefix;
  for (int letter = kTimeLetters - 1; letter >= 0; --letter) {
    id += kAlphabet[(stamp.time >> (5U * static_cast<unsigned>(letter))) % 32U];
  }
  for (const std::uint32_t digit : stamp.random) {
    id += kAlphabet[digit];
  }
  return id;
}

}  // namespace gaitmill
