#include <array>
#include <map>
#include <string>
#include <string_view>

#include "core/render/bone_shapes.h"
#include "core/render/bones.h"
#include "core/render/mesh_kit.h"

namespace gaitmill {

namespace {

using Vector3d = Eigen::Vector3d;

/// A body of the generic model.
struct Shape {
  std::string_view body;  ///< without the suffix of the side
  Mesh (*make)();
  double mesh_factor;  ///< that the generic model gives this body's meshes
};

constexpr std::array<Shape, 12> kShapes = {{
    {"pelvis", makePelvisBones, 1},
    {"torso", makeTorsoBones, 1},
    {"femur", makeFemurBones, 1},
    {"tibia", makeTibiaBones, 1},
    {"patella", makePatellaBones, 1},
    {"talus", makeTalusBones, 1},
    {"calcn", makeCalcaneusBones, 1},
    {"toes", makeToesBones, 1},
    {"humerus", makeHumerusBones, 1},
    {"ulna", makeUlnaBones, 1},
    {"radius", makeRadiusBones, 1},
    {"hand", makeHandBones, 0.85},
}};

bool isLeft(std::string_view body) {
  return body.size() > 2 && body.substr(body.size() - 2) == "_l";
}

const Shape* findShape(std::string_view body) {
  const std::string_view suffix = body.size() > 2 ? body.substr(body.size() - 2) : "";
  const std::string_view stem =
      suffix == "_r" || suffix == "_l" ? body.substr(0, body.size() - 2) : body;
  for (const Shape& shape : kShapes) {
    if (shape.body == stem) {
      return &shape;
    }
  }
  return nullptr;
}

// Made once per process: the shapes take a while to be polygonised.
const Mesh& getGenericMesh(const Shape& shape) {
  static const std::map<std::string_view, Mesh> meshes = [] {
    std::map<std::string_view, Mesh> made;
    for (const Shape& one : kShapes) {
      made[one.body] = one.make();
    }
    return made;
  }();
  return meshes.at(shape.body);
}

Vector3d findFactors(const BodySpec& body, double generic) {
  if (body.meshes.empty()) {
    return Vector3d::Ones();
  }
  return body.meshes.front().scale_factors / generic;
}

// Where the joint further out sits on the body: the end of a plain shaft.
const FrameSpec* findOuterJoint(const ModelSpec& model, const std::string& body) {
  for (const JointSpec& joint : model.joints) {
    if (joint.parent.body == body && joint.parent.translation.norm() > 1e-3) {
      return &joint.parent;
    }
  }
  return nullptr;
}

}  // namespace

Mesh makePlainShaft(const Vector3d& end) {
  const double radius = 0.05 * end.norm();
  return makeTube({{Vector3d::Zero(), 1.4 * radius},
                   {0.2 * end, 0.8 * radius},
                   {0.8 * end, 0.8 * radius},
                   {end, 1.4 * radius}},
                  {12, 4, 1, {}});
}

std::vector<BodyMesh> makeStylizedBones(const ModelSpec& model) {
  std::vector<BodyMesh> bones;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const BodySpec& body = model.bodies[i];
    const BodyIndex index(static_cast<int>(i));
    if (const Shape* shape = findShape(body.name)) {
      BodyMesh bone = {index, getGenericMesh(*shape)};
      const double side = isLeft(body.name) ? -1 : 1;
      scaleMesh(bone.mesh,
                findFactors(body, shape->mesh_factor).cwiseProduct(Vector3d(1, 1, side)));
      bones.push_back(std::move(bone));
    } else if (const FrameSpec* outer = findOuterJoint(model, body.name)) {
      bones.push_back({index, makePlainShaft(outer->translation)});
    }
  }
  return bones;
}

}  // namespace gaitmill
