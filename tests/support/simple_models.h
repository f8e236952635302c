#pragma once

#include <string>

#include "core/data/model_spec.h"

namespace gaitmill {

/// Rod of no mass with a point mass at its end, hanging from a pin about z; coordinate "angle".
inline ModelSpec makePendulum(double mass, double length) {
  ModelSpec spec;
  spec.bodies = {{"bob", mass, {0, -length, 0}, {0, 0, 0, 0, 0, 0}, {}}};
  JointSpec pin;
  pin.name = "pin";
  pin.kind = JointSpec::Kind::kPin;
  pin.parent.body = "ground";
  pin.child.body = "bob";
  pin.coordinates = {{"angle"}};
  spec.joints = {pin};
  return spec;
}

/// One body of 1 kg on a slider along x; coordinate "x".
inline ModelSpec makeSlider(const std::string& body_name) {
  ModelSpec spec;
  spec.bodies = {{body_name, 1.0, {0, 0, 0}, {0.1, 0.1, 0.1, 0, 0, 0}, {}}};
  JointSpec rail;
  rail.name = "rail";
  rail.kind = JointSpec::Kind::kSlider;
  rail.parent.body = "ground";
  rail.child.body = body_name;
  rail.coordinates = {{"x"}};
  spec.joints = {rail};
  return spec;
}

}  // namespace gaitmill
