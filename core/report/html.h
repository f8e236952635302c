#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Markup that may stand in a page. Words become markup through text() only, so that nothing from
/// outside can be taken for a tag.
class Html {
 public:
  Html() = default;
  const std::string& markup() const { return markup_; }
  bool empty() const { return markup_.empty(); }
  Html& operator+=(const Html& more);

 private:
  friend Html trusted(std::string markup);
  std::string markup_;
};
Html operator+(Html first, const Html& second);

/// Words, with everything escaped that means something in markup. Control characters, which HTML
/// does not allow, are left out.
Html text(const std::string& words);

/// Markup that this program has written itself: an SVG of core/figure.
Html trusted(std::string markup);

struct Attribute {
  const char* name;
  std::string value;  ///< escaped when written
};
using Attributes = std::vector<Attribute>;

/// <tag attributes>content</tag>
Html element(const char* tag, const Attributes& attributes, const Html& content);
Html element(const char* tag, const Html& content);
Html element(const char* tag, const std::string& words);
/// <tag attributes> without content: img, meta.
Html voidElement(const char* tag, const Attributes& attributes);

/// "data:image/png;base64,…"
std::string makeDataUri(const std::string& content_type, const std::string& bytes);

struct TableColumn {
  std::string heading;
  bool is_number = false;  ///< aligned to the right
};

/// A table with a caption and scoped headers; the first cell of a row is the row's header. Wide
/// tables scroll by themselves, so that the page does not.
class HtmlTable {
 public:
  HtmlTable(std::string caption, std::vector<TableColumn> columns);
  /// As many cells as there are columns.
  void addRow(const std::vector<Html>& cells);
  bool empty() const { return rows_.empty(); }
  Html render() const;

 private:
  std::string caption_;
  std::vector<TableColumn> columns_;
  Html rows_;
};

}  // namespace gaitmill
