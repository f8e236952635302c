#include "core/io/osim_element.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/io/file_content.h"
#include "core/io/number_text.h"

namespace gaitmill {

namespace {

// Oldest and newest document layout known (spec/model.md 9).
constexpr int kOldestVersion = 20302;
constexpr int kNewestVersion = 40600;
// Below this, names may hold blanks, which the conversion removes.
constexpr int kFirstVersionWithoutBlanks = 30500;

// Far above any model of a person (22 bodies, 97 forces), so that no document takes the square of a
// large number of objects.
constexpr std::size_t kMaximumBytes = 16U << 20U;
constexpr std::size_t kMaximumChildren = 2000;

constexpr std::string_view kBlank = " \t\r\n\v\f";

/// Calls visit(word, offset of the word in text) for every blank-separated word.
template <class Visit>
void forEachWord(std::string_view text, Visit visit) {
  std::size_t at = text.find_first_not_of(kBlank);
  while (at != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kBlank, at), text.size());
    visit(text.substr(at, end - at), at);
    at = text.find_first_not_of(kBlank, end);
  }
}

bool isOneOf(std::string_view name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

}  // namespace

std::string OsimElement::nameOr(const std::string& fallback) const {
  std::string name = node_.attribute("name").as_string();
  if (document_->version() < kFirstVersionWithoutBlanks) {
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  }
  return name.empty() ? fallback : name;
}

std::string OsimElement::requireName() const {
  std::string name = nameOr("");
  if (name.empty()) {
    fail(ErrorCode::kModelElement, "this " + std::string(type()) + " has no name attribute");
  }
  return name;
}

OsimElement OsimElement::property(const char* tag) const {
  if (document_ == nullptr) {
    return {};
  }
  pugi::xml_node found = node_.child(tag);
  if (!found) {
    const pugi::xml_node prototype = document_->findPrototype(type());
    if (prototype != node_) {
      found = prototype.child(tag);
    }
  }
  return {*document_, found};
}

OsimElement OsimElement::property(std::initializer_list<const char*> tags) const {
  for (const char* tag : tags) {
    if (OsimElement found = property(tag)) {
      return found;
    }
  }
  return {};
}

double OsimElement::number(const char* tag, double fallback) const {
  const OsimElement found = property(tag);
  return found ? found.ownNumbers(1)[0] : fallback;
}

double OsimElement::requireNumber(const char* tag) const {
  if (!has(tag)) {
    fail(ErrorCode::kModelElement, describe() + " has no <" + tag + ">");
  }
  return number(tag, 0);
}

bool OsimElement::boolean(const char* tag, bool fallback) const {
  const OsimElement found = property(tag);
  if (!found) {
    return fallback;
  }
  const std::optional<bool> value = parseBoolean(found.ownText());
  if (!value) {
    found.fail(ErrorCode::kModelValue,
               std::string("<") + tag + "> must be true or false, found '" + found.ownText() + "'");
  }
  return *value;
}

Eigen::Vector3d OsimElement::vector3(const char* tag, const Eigen::Vector3d& fallback) const {
  const OsimElement found = property(tag);
  if (!found) {
    return fallback;
  }
  const std::vector<double> v = found.ownNumbers(3);
  return {v[0], v[1], v[2]};
}

std::string OsimElement::text(const char* tag, const std::string& fallback) const {
  const OsimElement found = property(tag);
  return found ? found.ownText() : fallback;
}

std::vector<std::string> OsimElement::words(const char* tag) const {
  const OsimElement found = property(tag);
  return found ? found.ownWords() : std::vector<std::string>();
}

std::string OsimElement::ownText() const {
  return std::string(trim(node_.child_value()));
}

std::vector<std::string> OsimElement::ownWords() const {
  std::vector<std::string> result;
  forEachWord(node_.child_value(),
              [&](std::string_view word, std::size_t) { result.emplace_back(word); });
  return result;
}

std::vector<double> OsimElement::ownNumbers() const {
  std::vector<double> numbers;
  forEachWord(node_.child_value(), [&](std::string_view word, std::size_t at) {
    const std::optional<double> value = parseNumber(word);
    if (!value) {
      throw Error(
          ErrorCode::kModelValue,
          "<" + std::string(type()) + "> holds '" + std::string(word) + "', expected a number",
          whereToken(at));
    }
    numbers.push_back(*value);
  });
  return numbers;
}

std::vector<double> OsimElement::ownNumbers(std::size_t count) const {
  std::vector<double> numbers = ownNumbers();
  if (numbers.size() != count) {
    fail(ErrorCode::kModelValue,
         "<" + std::string(type()) + "> holds " + std::to_string(numbers.size()) +
             " numbers, expected " + std::to_string(count));
  }
  if (std::any_of(numbers.begin(), numbers.end(), [](double v) { return std::isnan(v); })) {
    fail(ErrorCode::kModelValue, "<" + std::string(type()) + "> is not a number");
  }
  return numbers;
}

std::vector<OsimElement> OsimElement::objectsOf(const char* set) const {
  return property(set).property("objects").children();
}

std::vector<OsimElement> OsimElement::children() const {
  std::vector<OsimElement> result;
  for (const pugi::xml_node& child : node_.children()) {
    if (child.type() == pugi::node_element) {
      result.emplace_back(*document_, child);
    }
  }
  if (result.size() > kMaximumChildren) {
    fail(ErrorCode::kModelUnsupported,
         describe() + " holds " + std::to_string(result.size()) + " objects; up to " +
             std::to_string(kMaximumChildren) + " are read");
  }
  return result;
}

OsimElement OsimElement::objectProperty(const char* tag,
                                        std::initializer_list<const char*> types) const {
  if (OsimElement wrapper = property(tag)) {
    const std::vector<OsimElement> inside = wrapper.children();
    return inside.empty() ? OsimElement() : inside.front();
  }
  OsimElement unnamed;
  for (const OsimElement& child : children()) {
    const char* name = child.node().attribute("name").as_string();
    if (std::strcmp(name, tag) == 0) {
      return child;
    }
    if (!unnamed && isOneOf(child.type(), types)) {
      unnamed = child;
    }
  }
  return unnamed;
}

OsimElement OsimElement::socket(const char* name,
                                std::initializer_list<const char*> old_tags) const {
  const std::string base = name;
  for (const std::string& tag : {"socket_" + base,
                                 "socket_" + base + "_connectee_name",
                                 "connector_" + base + "_connectee_name"}) {
    if (OsimElement found = property(tag.c_str())) {
      return found;
    }
  }
  for (const OsimElement& connector : property("connectors").children()) {
    if (connector.node().attribute("name").as_string() == base) {
      return connector.property("connectee_name");
    }
  }
  return property(old_tags);
}

std::string OsimElement::describe() const {
  const std::string name = node_.attribute("name").as_string();
  return std::string(type()) + (name.empty() ? "" : " '" + name + "'");
}

Where OsimElement::where() const {
  // pugixml remembers where the tag's name begins; the element begins one byte earlier.
  Where place = document_->whereOffset(node_.offset_debug() - 1);
  place.field = describe();
  return place;
}

Where OsimElement::whereToken(std::size_t offset_in_text) const {
  for (const pugi::xml_node& child : node_.children()) {
    if (child.type() == pugi::node_pcdata) {
      Where place = document_->whereOffset(child.offset_debug() +
                                           static_cast<std::ptrdiff_t>(offset_in_text));
      place.field = OsimElement(*document_, node_.parent()).describe();
      return place;
    }
  }
  return where();
}

void OsimElement::fail(ErrorCode code, const std::string& message) const {
  throw Error(code, message, where());
}

OsimDocument::OsimDocument(std::string_view bytes, const std::string& file_name)
    : bytes_(skipByteOrderMark(bytes)), file_name_(file_name) {
  requireData(bytes_, file_name_);
  require(bytes_.size() <= kMaximumBytes,
          ErrorCode::kFileTooLarge,
          "a model document of " + std::to_string(bytes_.size()) + " bytes; up to " +
              std::to_string(kMaximumBytes) + " are read",
          {file_name_, 1, 1, {}});
  parse();
  readVersion();
}

void OsimDocument::parse() {
  const pugi::xml_parse_result result =
      xml_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    throw Error(ErrorCode::kModelXml,
                std::string("not well-formed XML: ") + result.description(),
                whereOffset(result.offset));
  }
}

void OsimDocument::readVersion() {
  const OsimElement root(*this, xml_.document_element());
  if (root.type() != "OpenSimDocument") {
    root.fail(
        ErrorCode::kModelElement,
        "the document's root is <" + std::string(root.type()) + ">, expected <OpenSimDocument>");
  }
  const std::string text = root.node().attribute("Version").as_string();
  const std::optional<long> version = parseInteger(trim(text));
  if (!version || *version < kOldestVersion || *version > kNewestVersion) {
    root.fail(ErrorCode::kModelVersion,
              "document version is '" + text + "'; versions " + std::to_string(kOldestVersion) +
                  " to " + std::to_string(kNewestVersion) + " can be read");
  }
  version_ = static_cast<int>(*version);
}

OsimElement OsimDocument::root(const char* tag) const {
  const pugi::xml_node found = xml_.document_element().child(tag);
  if (!found) {
    OsimElement(*this, xml_.document_element())
        .fail(ErrorCode::kModelElement, std::string("the document holds no <") + tag + ">");
  }
  return {*this, found};
}

void OsimDocument::readPrototypes(const OsimElement& model) {
  prototypes_ = model.node().child("defaults");
  if (!prototypes_) {
    prototypes_ = xml_.document_element().child("defaults");
  }
  if (prototypes_) {
    static_cast<void>(OsimElement(*this, prototypes_).children());  // refuses too many
  }
}

pugi::xml_node OsimDocument::findPrototype(std::string_view type) const {
  for (const pugi::xml_node& prototype : prototypes_.children()) {
    if (prototype.name() == type) {
      return prototype;
    }
  }
  return {};
}

Where OsimDocument::whereOffset(std::ptrdiff_t offset) const {
  return offset < 0 ? Where{file_name_, 0, 0, {}}
                    : findWhere(bytes_, static_cast<std::size_t>(offset), file_name_);
}

}  // namespace gaitmill
