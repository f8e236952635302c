#include "service/draw_task.h"

#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/error.h"
#include "service/process/messages.h"
#include "service/storage/table_codec.h"

namespace gaitmill {

namespace {

using nlohmann::json;

json encodeOptions(const PictureOptions& options) {
  return {{"width", options.width},
          {"height", options.height},
          {"azimuth", options.view.azimuth},
          {"elevation", options.view.elevation},
          {"color", static_cast<int>(options.color)},
          {"bones", options.bones},
          {"muscles", options.muscles},
          {"markers", options.markers},
          {"forces", options.forces},
          {"ground", options.ground},
          {"legend", options.legend}};
}

PictureOptions decodeOptions(const json& document) {
  PictureOptions options;
  document.at("width").get_to(options.width);
  document.at("height").get_to(options.height);
  document.at("azimuth").get_to(options.view.azimuth);
  document.at("elevation").get_to(options.view.elevation);
  options.color = static_cast<MuscleColor>(document.at("color").get<int>());
  document.at("bones").get_to(options.bones);
  document.at("muscles").get_to(options.muscles);
  document.at("markers").get_to(options.markers);
  document.at("forces").get_to(options.forces);
  document.at("ground").get_to(options.ground);
  document.at("legend").get_to(options.legend);
  return options;
}

json encodeAxis(const Axis& axis) {
  json document = {{"label", axis.label}, {"unit", axis.unit}};
  if (axis.low) {
    document["low"] = *axis.low;
  }
  if (axis.high) {
    document["high"] = *axis.high;
  }
  return document;
}

Axis decodeAxis(const json& document) {
  Axis axis;
  document.at("label").get_to(axis.label);
  document.at("unit").get_to(axis.unit);
  if (document.contains("low")) {
    axis.low = document.at("low").get<double>();
  }
  if (document.contains("high")) {
    axis.high = document.at("high").get<double>();
  }
  return axis;
}

json encodeSeries(const Series& series) {
  return {{"name", series.name},
          {"role", static_cast<int>(series.role)},
          {"mark", static_cast<int>(series.mark)},
          {"x", series.x},
          {"y", series.y},
          {"low", series.low},
          {"categories", series.categories},
          {"group", series.group}};
}

int decodeInteger(const json& value) {
  require(value.is_number_integer(), ErrorCode::kJobCrashed, "a whole number is none");
  return static_cast<int>(value.get<std::int64_t>());
}

// An enumerator that travelled as its number.
template <class Enum>
Enum decodeEnum(const json& value, Enum last) {
  const int number = decodeInteger(value);
  require(number >= 0 && number <= static_cast<int>(last),
          ErrorCode::kJobCrashed,
          "a figure has a number that means nothing");
  return static_cast<Enum>(number);
}

// JSON has no NaN: what was not measured is null.
std::vector<double> decodeNumbers(const json& document) {
  std::vector<double> numbers;
  for (const json& number : document) {
    numbers.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                       : number.get<double>());
  }
  return numbers;
}

Series decodeSeries(const json& document) {
  Series series;
  document.at("name").get_to(series.name);
  series.role = decodeEnum(document.at("role"), SeriesRole::kEmg);
  series.mark = decodeEnum(document.at("mark"), SeriesMark::kBars);
  series.x = decodeNumbers(document.at("x"));
  series.y = decodeNumbers(document.at("y"));
  series.low = decodeNumbers(document.at("low"));
  document.at("categories").get_to(series.categories);
  series.group = decodeInteger(document.at("group"));
  return series;
}

json encodePanel(const Panel& panel) {
  json document = {{"name", panel.name},
                   {"title", panel.title},
                   {"x", encodeAxis(panel.x)},
                   {"y", encodeAxis(panel.y)},
                   {"note", panel.note},
                   {"series", json::array()},
                   {"guides", json::array()}};
  for (const Series& series : panel.series) {
    document["series"].push_back(encodeSeries(series));
  }
  for (const Guide& guide : panel.guides) {
    document["guides"].push_back({{"direction", static_cast<int>(guide.direction)},
                                  {"value", guide.value},
                                  {"label", guide.label}});
  }
  return document;
}

Panel decodePanel(const json& document) {
  Panel panel;
  document.at("name").get_to(panel.name);
  document.at("title").get_to(panel.title);
  panel.x = decodeAxis(document.at("x"));
  panel.y = decodeAxis(document.at("y"));
  document.at("note").get_to(panel.note);
  for (const json& series : document.at("series")) {
    panel.series.push_back(decodeSeries(series));
  }
  for (const json& guide : document.at("guides")) {
    panel.guides.push_back({decodeEnum(guide.at("direction"), Guide::Direction::kVertical),
                            guide.at("value").get<double>(),
                            guide.at("label").get<std::string>()});
  }
  return panel;
}

json encodeFigure(const Figure& figure) {
  json document = {{"name", figure.name},
                   {"title", figure.title},
                   {"caption", figure.caption},
                   {"columns", figure.columns},
                   {"panels", json::array()}};
  for (const Panel& panel : figure.panels) {
    document["panels"].push_back(encodePanel(panel));
  }
  return document;
}

Figure decodeFigure(const json& document) {
  Figure figure;
  document.at("name").get_to(figure.name);
  document.at("title").get_to(figure.title);
  document.at("caption").get_to(figure.caption);
  figure.columns = decodeInteger(document.at("columns"));
  for (const json& panel : document.at("panels")) {
    figure.panels.push_back(decodePanel(panel));
  }
  return figure;
}

}  // namespace

std::string encodeDrawTask(const DrawTask& task) {
  return json{{"kind", static_cast<int>(task.kind)},
              {"start", task.start},
              {"end", task.end},
              {"poses", task.poses},
              {"rate", task.rate},
              {"slow_down", task.slow_down},
              {"options", encodeOptions(task.options)},
              {"figure", task.figure},
              {"seed", task.seed}}
      .dump();
}

DrawTask decodeDrawTask(const std::string& text) {
  try {
    const json document = json::parse(text);
    DrawTask task;
    task.kind = decodeEnum(document.at("kind"), DrawTask::Kind::kValidation);
    document.at("start").get_to(task.start);
    document.at("end").get_to(task.end);
    document.at("poses").get_to(task.poses);
    document.at("rate").get_to(task.rate);
    document.at("slow_down").get_to(task.slow_down);
    task.options = decodeOptions(document.at("options"));
    document.at("figure").get_to(task.figure);
    document.at("seed").get_to(task.seed);
    return task;
  } catch (const json::exception& error) {
    throw Error(ErrorCode::kInternal, std::string("this is nothing to draw: ") + error.what());
  }
}

std::map<std::string, std::string> encodeDrawData(const DrawData& data) {
  return {{"model", data.picture.model_osim},
          {"model_name", data.model_name},
          {"kinematics", encodeTable(data.picture.kinematics)},
          {"muscle_values", encodeTable(data.picture.muscle_values)},
          {"ground_reactions", encodeTable(data.picture.ground_reactions)},
          {"markers", encodeTable(data.picture.markers)},
          {"cycle",
           data.picture.cycle
               ? packDouble(data.picture.cycle->start) + packDouble(data.picture.cycle->end)
               : ""}};
}

DrawData decodeDrawData(std::map<std::string, std::string> parts) {
  DrawData data;
  data.model_name = parts["model_name"];
  data.picture.model_osim = std::move(parts["model"]);
  data.picture.kinematics = decodeTable(parts["kinematics"]);
  data.picture.muscle_values = decodeTable(parts["muscle_values"]);
  data.picture.ground_reactions = decodeTable(parts["ground_reactions"]);
  data.picture.markers = decodeTable(parts["markers"]);
  const std::string& cycle = parts["cycle"];
  if (!cycle.empty()) {
    data.picture.cycle = GaitCycle{unpackDouble(cycle.substr(0, sizeof(double))),
                                   unpackDouble(cycle.substr(sizeof(double)))};
  }
  return data;
}

std::string encodeFigures(const std::vector<Figure>& figures) {
  json document = json::array();
  for (const Figure& figure : figures) {
    document.push_back(encodeFigure(figure));
  }
  return document.dump();
}

std::vector<Figure> decodeFigures(const std::string& text) {
  try {
    std::vector<Figure> figures;
    for (const json& figure : api::parseJson(text, "figures")) {
      figures.push_back(decodeFigure(figure));
    }
    return figures;
  } catch (const json::exception& error) {
    throw Error(ErrorCode::kJobCrashed, std::string("these are no figures: ") + error.what());
  } catch (const Error& error) {
    throw Error(ErrorCode::kJobCrashed, "these are no figures: " + error.message());
  }
}

}  // namespace gaitmill
