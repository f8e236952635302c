#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/data/time_series.h"
#include "core/math/events.h"

namespace gaitmill {

/// What muscles are coloured by.
enum class MuscleColor { kNone, kActivation, kForce, kFiberLength };

/// Where the camera stands, looking at the body's centre [rad]: azimuth 0 sees the right side
/// (sagittal plane, walking to the right), 90° the front; elevation is positive from above.
struct View {
  double azimuth = 0;
  double elevation = 0;
};

/// "sagittal", "frontal", "oblique" or "azimuth,elevation" in degrees.
/// @throws Error kRequestField saying what there is
View parseView(const std::string& text);

/// How results are to be shown.
struct PictureOptions {
  int width = 1280;  ///< [px] of one pose
  int height = 720;
  View view;
  MuscleColor color = MuscleColor::kActivation;
  bool bones = true;
  bool muscles = true;
  bool markers = true;  ///< measured and of the model
  bool forces = true;   ///< ground reactions
  bool ground = true;
  bool legend = true;
};

/// What a picture is made of: results of a job, as tables of the pipeline, and its model.
struct PictureData {
  std::string model_osim;    ///< document of the model that the motion belongs to
  TimeSeries kinematics;     ///< columns = coordinates [rad|m]
  TimeSeries muscle_values;  ///< columns = muscles: activation [-], force [N] or normalised fiber
                             ///< length [-]; no columns = not known
  TimeSeries ground_reactions;     ///< as result table "ground_reactions"; no columns = not known
  TimeSeries markers;              ///< as result table "measured_markers"; no columns = not known
  std::optional<GaitCycle> cycle;  ///< that labels state percentages of
};

/// Bytes of an image file.
struct Picture {
  std::string content_type;  ///< "image/png", "image/webp"
  std::string bytes;
};

/// Renders without display or GPU (OSMesa). Keeps the bones and the model of the last picture, so
/// that further ones of the same job cost only the drawing. One per thread; the library below is
/// used by one at a time.
class Painter {
 public:
  /// @param geometry_folder  .vtp, .stl and .obj meshes as the model names them; "" = stylised
  /// bones
  explicit Painter(std::string geometry_folder = "");
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// One pose. @param time [s]; outside the motion its nearest end
  /// @throws Error of the model reader; kRender if the renderer fails
  Picture paintPose(const PictureData& data, double time, const PictureOptions& options);
  /// `count` poses side by side, evenly from `start` to `end` [s], both included.
  Picture paintStrip(
      const PictureData& data, double start, double end, int count, const PictureOptions& options);
  /// An animated WebP that plays in real time divided by `slow_down`, at `rate` frames per second.
  Picture paintAnimation(const PictureData& data,
                         double start,
                         double end,
                         double rate,
                         double slow_down,
                         const PictureOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill
