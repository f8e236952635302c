#pragma once

namespace gaitmill {

// The two programs of the renderer, GLSL 1.20. Vertex attributes: 0 position, 1 normal, 2 colour.

inline constexpr const char* kLitVertexShader = R"(#version 120
attribute vec3 position;
attribute vec3 normal;
attribute vec4 color;
uniform mat4 clip;
uniform mat3 camera;
uniform vec3 eye;
varying vec3 normal_C;
varying vec3 toward_eye_C;
varying vec4 albedo;
void main() {
  gl_Position = clip * vec4(position, 1.0);
  normal_C = camera * normal;
  toward_eye_C = camera * (eye - position);
  albedo = color;
}
)";

// Key light from the upper left, fill from the right, sky and floor as soft ambient light, and a
// little darkening towards the silhouette, which parts neighbouring shapes as ink does.
inline constexpr const char* kLitFragmentShader = R"(#version 120
uniform vec3 up_C;
varying vec3 normal_C;
varying vec3 toward_eye_C;
varying vec4 albedo;
const vec3 key = vec3(-0.358, 0.698, 0.620);
const vec3 fill = vec3(0.793, 0.099, 0.601);
void main() {
  vec3 v = normalize(toward_eye_C);
  vec3 n = normalize(normal_C);
  float facing = dot(n, v);
  if (facing < 0.0) { n = -n; facing = -facing; }
  float sky = 0.5 + 0.5 * dot(n, up_C);
  vec3 ambient = mix(vec3(0.30, 0.28, 0.27), vec3(0.44, 0.46, 0.49), sky);
  float k = max((dot(n, key) + 0.15) / 1.15, 0.0);
  float f = max(dot(n, fill), 0.0);
  vec3 light = ambient + k * vec3(0.62, 0.60, 0.57) + f * vec3(0.13, 0.14, 0.17);
  float rim = 1.0 - facing;
  light *= 1.0 - 0.45 * rim * rim * rim;
  float s = max(dot(n, normalize(key + v)), 0.0);
  s *= s; s *= s; s *= s; s *= s; s *= s;
  gl_FragColor = vec4(albedo.rgb * light + vec3(0.45 * albedo.a * s), 1.0);
}
)";

inline constexpr const char* kFlatVertexShader = R"(#version 120
attribute vec3 position;
attribute vec4 color;
uniform mat4 clip;
varying vec4 shade;
void main() {
  gl_Position = clip * vec4(position, 1.0);
  shade = color;
}
)";

inline constexpr const char* kFlatFragmentShader = R"(#version 120
varying vec4 shade;
void main() { gl_FragColor = shade; }
)";

}  // namespace gaitmill
