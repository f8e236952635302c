#include "service/storage/ids.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <random>
#include <string_view>

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

std::string writeTime(std::uint64_t time) {
  std::string text;
  for (int letter = kTimeLetters - 1; letter >= 0; --letter) {
    text += kAlphabet[(time >> (5U * static_cast<unsigned>(letter))) % 32U];
  }
  return text;
}

}  // namespace

std::string makeId(const std::string& prefix) {
  const Stamp stamp = nextStamp();
  std::string id = prefix + writeTime(stamp.time);
  for (const std::uint32_t digit : stamp.random) {
    id += kAlphabet[digit];
  }
  return id;
}

bool isId(const std::string& text, const std::string& prefix) {
  return text.size() == prefix.size() + kTimeLetters + kRandomLetters &&
         text.compare(0, prefix.size(), prefix) == 0 &&
         text.find_first_not_of(kAlphabet.data(), prefix.size()) == std::string::npos;
}

std::int64_t findTimeOfId(const std::string& id) {
  const std::size_t begin = id.find('_') + 1;
  if (!isId(id, id.substr(0, begin))) {
    return 0;
  }
  std::int64_t time = 0;
  for (const char letter : id.substr(begin, kTimeLetters)) {
    time = time * 32 + static_cast<std::int64_t>(std::string_view(kAlphabet.data()).find(letter));
  }
  return time;
}

std::string makeIdBound(const std::string& prefix, std::int64_t milliseconds) {
  constexpr std::int64_t kLast = (std::int64_t{1} << (5 * kTimeLetters)) - 1;
  return prefix +
         writeTime(static_cast<std::uint64_t>(std::clamp<std::int64_t>(milliseconds, 0, kLast)));
}

}  // namespace gaitmill
