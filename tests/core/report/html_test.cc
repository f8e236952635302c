#include "core/report/html.h"

#include <string>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(HtmlText, EscapesWhatMeansSomethingInMarkup) {
  EXPECT_EQ(text("<script>alert('1' & \"2\")</script>").markup(),
            "&lt;script&gt;alert(&#39;1&#39; &amp; &quot;2&quot;)&lt;/script&gt;");
  EXPECT_EQ(text("Jos\u00e9 \u2013 5 N\u00b7m").markup(), "Jos\u00e9 \u2013 5 N\u00b7m");
}

TEST(HtmlText, LeavesOutControlCharacters) {
  EXPECT_EQ(text(std::string("a\0b\x1b[0mc\td\ne\x7f", 13)).markup(), "ab[0mc\td\ne");
}

TEST(HtmlElement, EscapesItsAttributes) {
  EXPECT_EQ(element("a", {{"href", "\"><script>"}}, text("b")).markup(),
            "<a href=\"&quot;&gt;&lt;script&gt;\">b</a>");
  EXPECT_EQ(voidElement("meta", {{"charset", "utf-8"}}).markup(), "<meta charset=\"utf-8\">");
}

TEST(HtmlElement, NestsWithoutEscapingTwice) {
  EXPECT_EQ(element("p", element("b", std::string("1 < 2")) + text(" & 3")).markup(),
            "<p><b>1 &lt; 2</b> &amp; 3</p>");
}

// The vectors of RFC 4648.
TEST(DataUri, IsBase64) {
  const auto encode = [](const std::string& bytes) {
    return makeDataUri("image/png", bytes);
  };
  const std::string head = "data:image/png;base64,";
  EXPECT_EQ(encode(""), head);
  EXPECT_EQ(encode("f"), head + "Zg==");
  EXPECT_EQ(encode("fo"), head + "Zm8=");
  EXPECT_EQ(encode("foo"), head + "Zm9v");
  EXPECT_EQ(encode("foobar"), head + "Zm9vYmFy");
  EXPECT_EQ(encode("\xff\xfe\xfd"), head + "//79");
}

TEST(HtmlTable, HasACaptionAndScopedHeaders) {
  HtmlTable table("Markers & more", {{"Marker"}, {"RMS", true}});
  EXPECT_TRUE(table.empty());
  table.addRow({text("RASI"), text("1.2")});
  EXPECT_EQ(table.render().markup(),
            "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"Markers &amp; more\">"
            "<table><caption>Markers &amp; more</caption>"
            "<thead><tr><th scope=\"col\">Marker</th><th scope=\"col\" class=\"number\">RMS</th>"
            "</tr></thead><tbody><tr><th scope=\"row\">RASI</th><td class=\"number\">1.2</td></tr>"
            "\n</tbody></table></div>");
}

}  // namespace
}  // namespace gaitmill
