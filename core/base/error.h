#pragma once

#include <cstddef>
#include <exception>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// Stable names of everything that can go wrong; see error_codes.inc for the list.
enum class ErrorCode {
#define GAITMILL_ERROR(enumerator, code, fix) enumerator,
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
};

/// "trc.column_count" for kTrcColumnCount. Never renamed once released.
std::string_view codeName(ErrorCode code);

/// What the user can do about an error of this kind: one sentence, the same for all occurrences.
std::string_view codeFix(ErrorCode code);

/// All codes, in declaration order (for tests and documentation).
const std::vector<ErrorCode>& allErrorCodes();

/// Place of a fault, in the input or in the computation; what is not known stays empty.
struct Where {
  std::string file{};
  int line = 0;         ///< 1-based, 0 = unknown
  int column = 0;       ///< 1-based, 0 = unknown
  std::string field{};  ///< JSON or XML element, request field or column label, as one would search
  std::string stage{};  ///< "ik"; empty outside the stages
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s] of the trial, NaN = unknown
  std::string marker{};
  std::string muscle{};
  std::string coordinate{};

  bool isEmpty() const;
  /// Takes over the members of `other` that are not known here.
  void complete(const Where& other);
};

/// The caller, the file or the request is wrong (or, for kInternal, we are). The message is one
/// sentence that says what was found and what was expected.
class Error : public std::exception {
 public:
  /// Longer messages, names and steps are cut: what quotes the input could quote all of it.
  static constexpr std::size_t kMaximumText = 2000;  ///< [bytes]

  Error(ErrorCode code, std::string message, Where where = {});

  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }
  const Where& where() const noexcept { return where_; }
  /// Steps that were under way, innermost first: "reading markers", "trial tri_7f3a".
  const std::vector<std::string>& context() const noexcept { return context_; }

  Error& addContext(std::string step);
  /// Names the file where a parser only knew line and column. Keeps a name already set.
  Error& setFile(const std::string& file);
  /// Adds what the thrower did not know of the place. Keeps what is already set.
  Error& completeWhere(const Where& known);

  /// "walk1.trc:214:1: row has 124 values, 41 markers need 125 [trc.column_count] (reading
  /// markers)"
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  void composeWhat();

  ErrorCode code_;
  std::string message_;
  Where where_;
  std::vector<std::string> context_;
  std::string what_;
};

/// Throws Error{code, message, where} unless `ok`: for conditions on input.
void require(bool ok, ErrorCode code, const std::string& message, const Where& where = {});

/// Throws Error{kInternal} unless `ok`: for invariants of our own; always on.
void check(bool ok, const char* message);

/// Element of `names` closest to `name` by edit distance, or empty if none is near.
/// For messages: "unknown field 'masss', did you mean 'mass'?"
std::string findNearestName(std::string_view name, const std::vector<std::string>& names);

}  // namespace gaitmill
