#include "api/dto/marker_names.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

json textOrNull(const std::string& text) {
  return text.empty() ? json(nullptr) : json(text);
}

std::string toText(const json& value) {
  return value.is_null() ? "" : value.get<std::string>();
}

json toJson(const MarkerNameView& name) {
  return {{"measured", name.measured},
          {"landmark", textOrNull(name.landmark)},
          {"confidence", name.confidence},
          {"reason", name.reason},
          {"set", textOrNull(name.set)},
          {"proposal", textOrNull(name.proposal)},
          {"proposal_confidence", name.proposal_confidence}};
}

MarkerNameView toMarkerName(const json& object) {
  return {object.at("measured"),
          toText(object.at("landmark")),
          object.at("confidence"),
          object.at("reason"),
          toText(object.at("set")),
          toText(object.at("proposal")),
          object.at("proposal_confidence")};
}

json toJson(const MissingLandmarksView& group) {
  return {{"part", group.part},
          {"needed", group.needed},
          {"found", group.found},
          {"any_of", group.any_of}};
}

}  // namespace

json toJson(const MarkerNamesView& names) {
  json object{{"set", textOrNull(names.set)},
              {"set_share", names.set_share},
              {"markers", json::array()},
              {"missing", json::array()}};
  for (const MarkerNameView& name : names.markers) {
    object["markers"].push_back(toJson(name));
  }
  for (const MissingLandmarksView& group : names.missing) {
    object["missing"].push_back(toJson(group));
  }
  return object;
}

MarkerNamesView toMarkerNames(const json& object) {
  MarkerNamesView names;
  names.set = toText(object.at("set"));
  names.set_share = object.at("set_share");
  for (const json& name : object.at("markers")) {
    names.markers.push_back(toMarkerName(name));
  }
  for (const json& group : object.at("missing")) {
    names.missing.push_back({group.at("part"),
                             group.at("needed"),
                             group.at("found"),
                             group.at("any_of").get<std::vector<std::string>>()});
  }
  return names;
}

}  // namespace gaitmill::api
