#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/io/c3d_bytes.h"

namespace gaitmill {

// The parameter section of a C3D file. Internal to core/io.

/// A number of the file as an integer; what is none, or is beyond 2^31, comes out as 0.
long toInteger(double number);

/// One parameter as the file has it; its values stay bytes until somebody asks.
struct C3dParameter {
  int type = 0;                         ///< -1 characters, 1 bytes, 2 words, 4 reals
  std::vector<std::size_t> dimensions;  ///< the first varies fastest; none = a single value
  std::size_t offset = 0;               ///< of the first value in the file
  std::size_t count = 0;                ///< of values
};

/// Parameters by group and name ("POINT", "RATE"), whatever their case and the order of records.
class C3dParameters {
 public:
  /// Reads the records from byte `begin` to byte `end` (clamped to the file). Each record is
  /// visited once, whatever its offsets say. Records that are cut off or of an unknown type are
  /// left out with a warning.
  C3dParameters(const C3dBytes& file,
                std::size_t begin,
                std::size_t end,
                std::vector<std::string>& warnings);

  const C3dParameter* find(std::string_view group, std::string_view name) const;

  /// Values as numbers, words as unsigned 16 bit; empty if there is no such parameter or if it is
  /// text.
  std::vector<double> findNumbers(std::string_view group, std::string_view name) const;
  /// Words as signed 16 bit: what may be negative (ANALOG:OFFSET, FORCE_PLATFORM:CHANNEL).
  std::vector<double> findSignedNumbers(std::string_view group, std::string_view name) const;
  /// First value of findNumbers.
  std::optional<double> findNumber(std::string_view group, std::string_view name) const;
  /// Texts as UTF-8, without blanks and NULs at either side; empty if there is no such parameter or
  /// if it is not text.
  std::vector<std::string> findTexts(std::string_view group, std::string_view name) const;
  std::string findText(std::string_view group, std::string_view name) const;

  /// findTexts of the name followed by those of name2, name3, ...: a parameter holds 255 texts at
  /// most, further ones overflow into the next. Ends at the first one that is missing or empty.
  std::vector<std::string> findAllTexts(std::string_view group, const std::string& name) const;
  /// Likewise of numbers.
  std::vector<double> findAllNumbers(std::string_view group, const std::string& name) const;
  std::vector<double> findAllSignedNumbers(std::string_view group, const std::string& name) const;

 private:
  enum class Words { kUnsigned, kSigned };
  std::vector<double> readNumbers(const C3dParameter* parameter, Words words) const;

  C3dBytes file_;
  std::unordered_map<std::string, C3dParameter> parameters_;  // "POINT:RATE"
};

}  // namespace gaitmill
