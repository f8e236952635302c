#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/base/error.h"

namespace gaitmill {

class OsimDocument;

/// One object of a model document (a body, a joint, a muscle), seen through the document's rules:
/// a property that the object does not state comes from the prototype of its type in <defaults>
/// (spec/model.md 2), failing that from the class default that the caller passes. A null element
/// stands for an object that is not there: all its properties have their defaults.
/// Every error names file, line and column. Internal to core/io.
class OsimElement {
 public:
  OsimElement() = default;
  OsimElement(const OsimDocument& document, pugi::xml_node node)
      : document_(&document), node_(node) {}

  explicit operator bool() const { return !node_.empty(); }
  const pugi::xml_node& node() const { return node_; }
  std::string_view type() const { return node_.name(); }
  /// The name attribute; blanks removed in documents below 30500. @throws Error kModelElement if
  /// the element has none
  std::string requireName() const;
  std::string nameOr(const std::string& fallback) const;

  /// Child element stated by the object or by the prototype of its type; null if neither does.
  OsimElement property(const char* tag) const;
  /// The first of several spellings of one property that is stated.
  OsimElement property(std::initializer_list<const char*> tags) const;
  bool has(const char* tag) const { return static_cast<bool>(property(tag)); }

  double number(const char* tag, double fallback) const;
  double requireNumber(const char* tag) const;
  bool boolean(const char* tag, bool fallback) const;
  Eigen::Vector3d vector3(const char* tag, const Eigen::Vector3d& fallback) const;
  std::string text(const char* tag, const std::string& fallback = "") const;
  std::vector<std::string> words(const char* tag) const;

  /// What this element itself contains.
  std::string ownText() const;
  std::vector<std::string> ownWords() const;
  std::vector<double> ownNumbers() const;
  /// Exactly `count` finite numbers. @throws Error kModelValue
  std::vector<double> ownNumbers(std::size_t count) const;

  /// Typed elements of <set><objects> in document order; empty if there is no such set.
  std::vector<OsimElement> objectsOf(const char* set) const;
  /// All child elements.
  std::vector<OsimElement> children() const;
  /// Object that is the value of property `tag`, in any of the three spellings of spec/model.md 1;
  /// null if the property is absent or empty. Its type must be one of `types` if it is unnamed.
  OsimElement objectProperty(const char* tag, std::initializer_list<const char*> types) const;
  /// Name that a socket refers to: <socket_X>, the 4.0-beta spellings of it, or one of `old_tags`.
  OsimElement socket(const char* name, std::initializer_list<const char*> old_tags = {}) const;

  /// "Millard2012EquilibriumMuscle 'soleus_r'"
  std::string describe() const;
  Where where() const;
  [[noreturn]] void fail(ErrorCode code, const std::string& message) const;

  const OsimDocument& document() const { return *document_; }

 private:
  Where whereToken(std::size_t offset_in_text) const;

  const OsimDocument* document_ = nullptr;
  pugi::xml_node node_;
};

/// A parsed model document: owns the XML, knows its version and prototypes.
class OsimDocument {
 public:
  /// @throws Error kModelXml, kModelVersion, kModelElement, kFileNotTheData, kFileEmpty
  OsimDocument(std::string_view bytes, const std::string& file_name);
  OsimDocument(const OsimDocument&) = delete;
  OsimDocument& operator=(const OsimDocument&) = delete;
  ~OsimDocument() = default;

  int version() const { return version_; }
  /// First child of the root with that tag, for instance "Model" or "MarkerSet".
  OsimElement root(const char* tag) const;
  void readPrototypes(const OsimElement& model);
  pugi::xml_node findPrototype(std::string_view type) const;
  Where whereOffset(std::ptrdiff_t offset) const;

 private:
  void parse();
  void readVersion();

  std::string_view bytes_;
  std::string file_name_;
  pugi::xml_document xml_;
  pugi::xml_node prototypes_;
  int version_ = 0;
};

}  // namespace gaitmill
