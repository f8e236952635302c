#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace gaitmill {

/// Stable names of everything that can go wrong; see error_codes.inc for the list.
enum class ErrorCode {
#define GAITMILL_ERROR(enumerator, code) enumerator,
#include "core/base/error_codes.inc"
#undef GAITMILL_ERROR
};

/// "trc.column_count" for kTrcColumnCount. Never renamed once released.
std::string_view codeName(ErrorCode code);

/// All codes, in declaration order (for tests and documentation).
const std::vector<ErrorCode>& allErrorCodes();

/// Place of a fault in the input. Line and column are 1-based, 0 = unknown. `field` names a JSON or
/// XML element, a marker, a coordinate or a column label, whichever the reader would search for.
struct Where {
  std::string file;
  int line = 0;
  int column = 0;
  std::string field;
};

/// The caller, the file or the request is wrong (or, for kInternal, we are). The message is one
/// sentence that says what was found and what was expected.
class Error : public std::exception {
 public:
  Error(ErrorCode code, std::string message, Where where = {});

  ErrorCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }
  const Where& where() const noexcept { return where_; }
  /// Steps that were under way, innermost first: "reading markers", "trial tri_7f3a".
  const std::vector<std::string>& context() const noexcept { return context_; }

  Error& addContext(std::string step);
  /// Names the file where a parser only knew line and column. Keeps a name already set.
  Error& setFile(const std::string& file);

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
