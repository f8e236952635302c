#include "core/report/html.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/error.h"
#include "core/figure/markup.h"

namespace gaitmill {

namespace {

std::string escape(const std::string& words) {
  std::string allowed;
  for (const char letter : words) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool is_control = byte < 0x20 && letter != '\n' && letter != '\t';
    if (!is_control && byte != 0x7f) {
      allowed += letter;
    }
  }
  return escapeMarkup(allowed);
}

std::string openTag(const char* tag, const Attributes& attributes) {
  std::string markup = std::string("<") + tag;
  for (const Attribute& attribute : attributes) {
    markup += std::string(" ") + attribute.name + "=\"" + escape(attribute.value) + "\"";
  }
  return markup + ">";
}

// RFC 4648
std::string encodeBase64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto at = [&](std::size_t i) -> std::uint32_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  std::string digits;
  digits.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t group = at(i) << 16U | at(i + 1) << 8U | at(i + 2);
    digits += kDigits[group >> 18U & 63U];
    digits += kDigits[group >> 12U & 63U];
    digits += i + 1 < bytes.size() ? kDigits[group >> 6U & 63U] : '=';
    digits += i + 2 < bytes.size() ? kDigits[group & 63U] : '=';
  }
  return digits;
}

}  // namespace

Html& Html::operator+=(const Html& more) {
  markup_ += more.markup_;
  return *this;
}

Html operator+(Html first, const Html& second) {
  first += second;
  return first;
}

Html trusted(std::string markup) {
  Html html;
  html.markup_ = std::move(markup);
  return html;
}

Html text(const std::string& words) {
  return trusted(escape(words));
}

Html element(const char* tag, const Attributes& attributes, const Html& content) {
  return trusted(openTag(tag, attributes) + content.markup() + "</" + tag + ">");
}

Html element(const char* tag, const Html& content) {
  return element(tag, {}, content);
}

Html element(const char* tag, const std::string& words) {
  return element(tag, {}, text(words));
}

Html voidElement(const char* tag, const Attributes& attributes) {
  return trusted(openTag(tag, attributes));
}

std::string makeDataUri(const std::string& content_type, const std::string& bytes) {
  return "data:" + content_type + ";base64," + encodeBase64(bytes);
}

HtmlTable::HtmlTable(std::string caption, std::vector<TableColumn> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void HtmlTable::addRow(const std::vector<Html>& cells) {
  check(cells.size() == columns_.size(), "a row has one cell per column");
  Html row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Attributes attributes;
    if (i == 0) {
      attributes.push_back({"scope", "row"});
    }
    if (columns_[i].is_number) {
      attributes.push_back({"class", "number"});
    }
    row += element(i == 0 ? "th" : "td", attributes, cells[i]);
  }
  rows_ += element("tr", row) + trusted("\n");
}

Html HtmlTable::render() const {
  Html head;
  for (const TableColumn& column : columns_) {
    Attributes attributes = {{"scope", "col"}};
    if (column.is_number) {
      attributes.push_back({"class", "number"});
    }
    head += element("th", attributes, text(column.heading));
  }
  const Html table = element("table",
                             element("caption", caption_) + element("thead", element("tr", head)) +
                                 element("tbody", rows_));
  // The keyboard can scroll what can be focused.
  return element(
      "div",
      {{"class", "wide"}, {"role", "region"}, {"tabindex", "0"}, {"aria-label", caption_}},
      table);
}

}  // namespace gaitmill
