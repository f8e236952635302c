#include "core/figure/markup.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(EscapeMarkup, LeavesNoLetterThatOpensATagAnEntityOrAValue) {
  EXPECT_EQ(escapeMarkup("<a href=\"x\">R&D's</a>"),
            "&lt;a href=&quot;x&quot;&gt;R&amp;D&#39;s&lt;/a&gt;");
}

TEST(EscapeMarkup, LeavesOtherTextAsItIs) {
  EXPECT_EQ(escapeMarkup("N·m, 12 %\n"), "N·m, 12 %\n");
  EXPECT_EQ(escapeMarkup(""), "");
}

}  // namespace
}  // namespace gaitmill
