// Draws pictures from tables on disk, for looking at them:
//   gaitmill_picture OUT pose|strip|animation key=value...
// Keys: model, kinematics, values, reactions, markers (files); geometry (folder); view, color
// (none|activation|force|length), width, height, time, start, end, count, rate, slow, cycle (a,b);
// hide (letters: b bones, m muscles, k markers, f forces, g ground, l legend).
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/render/picture.h"

namespace gaitmill {
namespace {

class Arguments {
 public:
  Arguments(int count, char** texts) {
    for (int i = 3; i < count; ++i) {
      const std::string text = texts[i];
      const std::size_t equals = text.find('=');
      values_[text.substr(0, equals)] = text.substr(equals + 1);
    }
  }
  std::string get(const std::string& key, const std::string& otherwise) const {
    const auto found = values_.find(key);
    return found == values_.end() ? otherwise : found->second;
  }
  double number(const std::string& key, double otherwise) const {
    const auto found = values_.find(key);
    return found == values_.end() ? otherwise : std::strtod(found->second.c_str(), nullptr);
  }

 private:
  std::map<std::string, std::string> values_;
};

TimeSeries readIfNamed(const std::string& path) {
  if (path.empty()) return {};
  return readTable(readFile(path), path).table;
}

PictureData readData(const Arguments& arguments) {
  PictureData data;
  const std::string model = arguments.get("model", "models/rajagopal2016/rajagopal2016.osim");
  data.model_osim = readFile(model);
  const std::string kinematics = arguments.get("kinematics", "");
  if (!kinematics.empty()) {
    std::vector<std::string> ignored;
    data.kinematics = toCoordinates(
        readTable(readFile(kinematics), kinematics), readOsim(data.model_osim, model), &ignored);
  }
  data.muscle_values = readIfNamed(arguments.get("values", ""));
  data.ground_reactions = readIfNamed(arguments.get("reactions", ""));
  data.markers = readIfNamed(arguments.get("markers", ""));
  const std::string cycle = arguments.get("cycle", "");
  if (!cycle.empty()) {
    data.cycle = GaitCycle{std::strtod(cycle.c_str(), nullptr),
                           std::strtod(cycle.c_str() + cycle.find(',') + 1, nullptr)};
  }
  return data;
}

PictureOptions readOptions(const Arguments& arguments) {
  PictureOptions options;
  options.width = static_cast<int>(arguments.number("width", 1280));
  options.height = static_cast<int>(arguments.number("height", 720));
  options.view = parseView(arguments.get("view", "sagittal"));
  const std::map<std::string, MuscleColor> colors = {{"none", MuscleColor::kNone},
                                                     {"activation", MuscleColor::kActivation},
                                                     {"force", MuscleColor::kForce},
                                                     {"length", MuscleColor::kFiberLength}};
  options.color = colors.at(arguments.get("color", "activation"));
  const std::string hidden = arguments.get("hide", "");
  const auto shown = [&](char letter) {
    return hidden.find(letter) == std::string::npos;
  };
  options.bones = shown('b');
  options.muscles = shown('m');
  options.markers = shown('k');
  options.forces = shown('f');
  options.ground = shown('g');
  options.legend = shown('l');
  return options;
}

Picture paint(const std::string& what, const Arguments& arguments) {
  const PictureData data = readData(arguments);
  const PictureOptions options = readOptions(arguments);
  Painter painter(arguments.get("geometry", ""));
  const double start = arguments.number("start", 0), end = arguments.number("end", 1);
  if (what == "strip") {
    const int count = static_cast<int>(arguments.number("count", 6));
    return painter.paintStrip(data, start, end, count, options);
  }
  if (what == "animation") {
    return painter.paintAnimation(
        data, start, end, arguments.number("rate", 25), arguments.number("slow", 2), options);
  }
  return painter.paintPose(data, arguments.number("time", 0), options);
}

}  // namespace
}  // namespace gaitmill

int main(int count, char** texts) {
  if (count < 3) {
    std::cerr << "usage: gaitmill_picture OUT pose|strip|animation key=value...\n";
    return 2;
  }
  try {
    const gaitmill::Arguments arguments(count, texts);
    gaitmill::writeFile(texts[1], gaitmill::paint(texts[2], arguments).bytes);
  } catch (const gaitmill::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
