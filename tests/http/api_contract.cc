#include "tests/http/api_contract.h"

#include <yaml.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/http/json_schema.h"

namespace gaitmill {

namespace {

using nlohmann::json;

json convertScalar(const yaml_node_t& node) {
  const std::string text(reinterpret_cast<const char*>(node.data.scalar.value),
                         node.data.scalar.length);
  if (node.data.scalar.style != YAML_PLAIN_SCALAR_STYLE) {
    return text;
  }
  const json value = json::parse(text, nullptr, false);
  return value.is_discarded() ? json(text) : value;
}

json convert(yaml_document_t& document, int index) {
  const yaml_node_t& node = *yaml_document_get_node(&document, index);
  if (node.type == YAML_SCALAR_NODE) {
    return convertScalar(node);
  }
  if (node.type == YAML_SEQUENCE_NODE) {
    json list = json::array();
    for (auto* item = node.data.sequence.items.start; item < node.data.sequence.items.top; ++item) {
      list.push_back(convert(document, *item));
    }
    return list;
  }
  json object = json::object();
  for (auto* pair = node.data.mapping.pairs.start; pair < node.data.mapping.pairs.top; ++pair) {
    const json key = convert(document, pair->key);
    object[key.is_string() ? key.get<std::string>() : key.dump()] = convert(document, pair->value);
  }
  return object;
}

json readYaml(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  const std::string bytes = text.str();
  yaml_parser_t parser;
  yaml_document_t document;
  yaml_parser_initialize(&parser);
  yaml_parser_set_input_string(
      &parser, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  if (yaml_parser_load(&parser, &document) == 0 ||
      yaml_document_get_root_node(&document) == nullptr) {
    throw std::runtime_error(path + ": not YAML, line " +
                             std::to_string(parser.problem_mark.line + 1));
  }
  json root = convert(document, 1);
  yaml_document_delete(&document);
  yaml_parser_delete(&parser);
  return root;
}

std::string toUpper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  return text;
}

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

}  // namespace

ApiContract::ApiContract() : document_(readYaml("api/openapi.yaml")) {}

const json& ApiContract::resolve(const json& object) const {
  return object.contains("$ref")
             ? document_.at(json::json_pointer(object.at("$ref").get<std::string>().substr(1)))
             : object;
}

std::set<ApiContract::Answer> ApiContract::listAnswers() const {
  std::set<Answer> answers;
  for (const auto& [path, item] : document_.at("paths").items()) {
    for (const auto& [method, operation] : item.items()) {
      if (method == "parameters") {
        continue;
      }
      for (const auto& [status, response] : operation.at("responses").items()) {
        answers.emplace(toUpper(method), path, std::stoi(status));
      }
    }
  }
  return answers;
}

std::vector<std::string> ApiContract::findFaults(const std::string& method,
                                                 const std::string& path,
                                                 const ClientReply& reply) const {
  const json& responses = document_.at("paths").at(path).at(toLower(method)).at("responses");
  const std::string status = std::to_string(reply.status);
  if (!responses.contains(status)) {
    return {"status " + status + " is not documented: " + reply.body};
  }
  const json& response = resolve(responses.at(status));
  const auto type = reply.headers.find("Content-Type");
  const std::string full_type = type == reply.headers.end() ? "" : type->second;
  const std::string media_type = full_type.substr(0, full_type.find(';'));
  if (!response.at("content").contains(media_type)) {
    return {"media type " + media_type + " is not documented for " + status};
  }
  std::vector<std::string> faults;
  if (media_type == "application/json") {
    faults = findSchemaFaults(
        reply.json(), response.at("content").at(media_type).at("schema"), document_);
  }
  const json headers = response.value("headers", json::object());
  for (const auto& [name, header] : headers.items()) {
    if (reply.headers.count(name) == 0) {
      faults.push_back("header " + name + " is missing");
    }
  }
  return faults;
}

}  // namespace gaitmill
