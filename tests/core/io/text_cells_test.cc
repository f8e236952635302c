#include "core/io/text_cells.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

TEST(TextCells, LinesEndInAnyOfThreeWays) {
  LineReader lines("a\r\nb\nc\rd");
  std::vector<std::string> found;
  while (lines.next()) {
    found.emplace_back(lines.line());
  }
  EXPECT_EQ(found, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(lines.number(), 4);
}

TEST(TextCells, EmptyLinesCount) {
  LineReader lines("\n\r\n\nx");
  while (lines.next()) {
  }
  EXPECT_EQ(lines.number(), 4);
}

TEST(TextCells, WideLinesAreNotSplitWhole) {
  std::vector<Cell> cells;
  splitAt(',', std::string(10 * kMaximumCells, ','), cells);
  EXPECT_EQ(cells.size(), kMaximumCells + 1);
  std::string words;
  for (std::size_t i = 0; i < 2 * kMaximumCells; ++i) {
    words += "a ";
  }
  splitAtBlanks(words, cells);
  EXPECT_EQ(cells.size(), kMaximumCells + 1);
}

TEST(TextCells, CellsKnowWhereTheirTextBegins) {
  std::vector<Cell> cells;
  splitAt('\t', "a\t\t  b \t", cells);
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(cells[1].text, "");
  EXPECT_EQ(cells[2].text, "b");
  EXPECT_EQ(cells[2].column, 6);
  dropEmptyTail(cells);
  EXPECT_EQ(cells.size(), 3u);
  splitAtBlanks(" \tx  y", cells);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].column, 3);
  EXPECT_EQ(cells[1].column, 6);
}

TEST(TextCells, FindingsThrowTheFirstAndTellTheOthers) {
  Findings findings("f");
  EXPECT_NO_THROW(findings.throwIfAny());
  findings.add(ErrorCode::kTableNumber, "first", 3, 4);
  findings.add(ErrorCode::kTableColumnCount, "second", 5, 6);
  try {
    findings.throwIfAny();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.message(), "first");
    EXPECT_EQ(error.where().line, 3);
    ASSERT_EQ(error.context().size(), 1u);
    EXPECT_EQ(error.context()[0], "also line 5, column 6: second");
  }
}

}  // namespace
}  // namespace gaitmill
