// Turns openapi.yaml into a source file with the same document as JSON, when gaitmill is built.
// Usage: gaitmill_embed_openapi openapi.yaml openapi_document.cc

#include <yaml.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace {

using nlohmann::ordered_json;

ordered_json convertScalar(const yaml_node_t& node) {
  const std::string text(reinterpret_cast<const char*>(node.data.scalar.value),
                         node.data.scalar.length);
  if (node.data.scalar.style != YAML_PLAIN_SCALAR_STYLE) {
    return text;
  }
  ordered_json value = ordered_json::parse(text, nullptr, false);
  return value.is_discarded() ? ordered_json(text) : value;
}

ordered_json convert(yaml_document_t& document, int index) {
  const yaml_node_t& node = *yaml_document_get_node(&document, index);
  if (node.type == YAML_SCALAR_NODE) {
    return convertScalar(node);
  }
  if (node.type == YAML_SEQUENCE_NODE) {
    ordered_json list = ordered_json::array();
    for (auto* item = node.data.sequence.items.start; item < node.data.sequence.items.top; ++item) {
      list.push_back(convert(document, *item));
    }
    return list;
  }
  ordered_json object = ordered_json::object();
  for (auto* pair = node.data.mapping.pairs.start; pair < node.data.mapping.pairs.top; ++pair) {
    const ordered_json key = convert(document, pair->key);
    object[key.is_string() ? key.get<std::string>() : key.dump()] = convert(document, pair->value);
  }
  return object;
}

ordered_json readYaml(const std::string& path) {
  std::ifstream file(path);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  yaml_parser_t parser;
  yaml_document_t document;
  yaml_parser_initialize(&parser);
  yaml_parser_set_input_string(
      &parser, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  if (yaml_parser_load(&parser, &document) == 0 ||
      yaml_document_get_root_node(&document) == nullptr) {
    throw std::runtime_error(path + " is not valid YAML, line " +
                             std::to_string(parser.problem_mark.line + 1));
  }
  ordered_json value = convert(document, 1);
  yaml_document_delete(&document);
  yaml_parser_delete(&parser);
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  std::ofstream source(argv[2]);
  source << "#include \"api/openapi.h\"\n\nnamespace gaitmill::api {\n\n"
            "const std::string& openApiDocument() {\n  static const std::string document =\n";
  // In pieces, because compilers bound the length of one literal.
  constexpr std::size_t kPiece = 2000;
  const std::string text = readYaml(argv[1]).dump();
  for (std::size_t begin = 0; begin < text.size(); begin += kPiece) {
    source << "      R\"json(" << text.substr(begin, kPiece) << ")json\"\n";
  }
  source << "      ;\n  return document;\n}\n\n}  // namespace gaitmill::api\n";
  source.close();
  return source.fail() ? 1 : 0;
}
