#include "core/io/file_content.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(FileContent, PlaceCountsLinesAndColumnsFromOne) {
  const std::string text = "ab\r\nc\rd\n\tx";
  EXPECT_EQ(findWhere(text, 0, "f").line, 1);
  EXPECT_EQ(findWhere(text, 4, "f").line, 2);
  EXPECT_EQ(findWhere(text, 4, "f").column, 1);
  EXPECT_EQ(findWhere(text, 6, "f").line, 3);
  const Where x = findWhere(text, text.size() - 1, "f");
  EXPECT_EQ(x.line, 4);
  EXPECT_EQ(x.column, 2) << "a tab is one column";
}

TEST(FileContent, ByteOrderMarkIsSkippedOnce) {
  EXPECT_EQ(skipByteOrderMark("\xEF\xBB\xBFx"), "x");
  EXPECT_EQ(skipByteOrderMark("x"), "x");
}

}  // namespace
}  // namespace gaitmill
