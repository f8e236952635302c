#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace gaitmill {

// Lines and cells of text tables. Internal to core/io.

/// Walks through the lines of a text; \r\n, \n and lone \r end lines.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// Moves to the next line; false at the end.
  bool next();
  std::string_view line() const { return line_; }
  int number() const { return number_; }  ///< 1-based
  bool atEnd() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
};

/// One cell of a line: its text without surrounding blanks and where that begins (from 1; a tab
/// counts one).
struct Cell {
  std::string_view text;
  int column = 0;
};

/// Widest row that a table may have; a full-body model's widest table has some 300 columns. A line
/// of separators would cost 24 bytes of memory for each of its own.
inline constexpr std::size_t kMaximumCells = 65536;

/// Cells between separators, empty ones included, for instance "a\t\tb" -> "a", "", "b". Stops
/// after kMaximumCells + 1 cells.
void splitAt(char separator, std::string_view line, std::vector<Cell>& cells);

/// Words between any mix of blanks and tabs; stops likewise.
void splitAtBlanks(std::string_view line, std::vector<Cell>& cells);

/// Drops empty cells at the end.
void dropEmptyTail(std::vector<Cell>& cells);

/// Faults of one file, gathered so that a reader can report several at once.
class Findings {
 public:
  explicit Findings(std::string file_name) : file_name_(std::move(file_name)) {}

  void add(
      ErrorCode code, const std::string& message, int line, int column, std::string field = "");
  /// True when so many faults are known that reading on helps nobody.
  bool isFull() const { return errors_.size() >= kMaximum; }
  /// Throws the first fault with the others as context; nothing if there are none.
  void throwIfAny() const;

 private:
  static constexpr std::size_t kMaximum = 10;
  std::string file_name_;
  std::vector<Error> errors_;
};

}  // namespace gaitmill
