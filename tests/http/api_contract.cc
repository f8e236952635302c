#include "tests/http/api_contract.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "api/openapi.h"
#include "tests/http/json_schema.h"

namespace gaitmill {

namespace {

using nlohmann::json;

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

std::string toUpper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  return text;
}

// Schema of a piece of JSON, which is not JSON.
const json kText = {{"type", "string"}};

bool isJson(const std::string& media_type) {
  return media_type == "application/json" || media_type == "application/problem+json";
}

}  // namespace

ApiContract::ApiContract() : document_(json::parse(api::openApiDocument())) {}

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

std::vector<std::string> ApiContract::listMediaTypes(const Answer& answer) const {
  const json& response = findResponse(answer);
  std::vector<std::string> types;
  const json content = response.value("content", json::object());
  for (const auto& [type, unused] : content.items()) {
    types.push_back(type);
  }
  return types;
}

const json& ApiContract::findResponse(const Answer& answer) const {
  const auto& [method, path, status] = answer;
  return resolve(document_.at("paths")
                     .at(path)
                     .at(toLower(method))
                     .at("responses")
                     .at(std::to_string(status)));
}

std::vector<std::string> ApiContract::findFaults(const std::string& method,
                                                 const std::string& path,
                                                 const ClientReply& reply) const {
  if (listAnswers().count({method, path, reply.status}) == 0) {
    return {"status " + std::to_string(reply.status) + " is not documented: " + reply.body};
  }
  const json& response = findResponse({method, path, reply.status});
  std::map<std::string, std::string> headers;
  for (const auto& [name, value] : reply.headers) {
    headers[toLower(name)] = value;
  }
  std::vector<std::string> faults = findBodyFaults(response, headers["content-type"], reply.body);
  const json documented = response.value("headers", json::object());
  for (const auto& [name, reference] : documented.items()) {
    const json& header = resolve(reference);
    const auto found = headers.find(toLower(name));
    if (found == headers.end()) {
      if (header.value("required", false)) {
        faults.push_back("header " + name + " is missing");
      }
      continue;
    }
    for (const auto& fault : findSchemaFaults(found->second, header.at("schema"), document_)) {
      faults.push_back("header " + name + ": " + fault);
    }
  }
  return faults;
}

std::vector<std::string> ApiContract::findBodyFaults(const json& response,
                                                     const std::string& content_type,
                                                     const std::string& body) const {
  const std::string media_type = content_type.substr(0, content_type.find(';'));
  if (!response.contains("content")) {
    return body.empty() ? std::vector<std::string>{}
                        : std::vector<std::string>{"has a body, though none is documented"};
  }
  if (!response.at("content").contains(media_type)) {
    return {"media type '" + media_type + "' is not documented"};
  }
  if (!isJson(media_type) || response.at("content").at(media_type).at("schema") == kText) {
    return {};
  }
  return findSchemaFaults(
      json::parse(body), response.at("content").at(media_type).at("schema"), document_);
}

}  // namespace gaitmill
