#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gaitmill::api {

enum class ImageKind { kPose, kStrip, kAnimation };

/// What an image is to show, as asked for: GET /v1/jobs/{id}/images/….
struct ImageRequest {
  ImageKind kind = ImageKind::kPose;
  std::optional<double> time;     ///< [s] of a pose
  std::optional<double> percent;  ///< of the gait cycle, in place of `time`
  std::optional<double> start;    ///< [s] of a strip or an animation; absent = the gait cycle's, or
                                  ///< the motion's where there is none
  std::optional<double> end;      ///< [s]
  int poses = 6;                  ///< of a strip
  double rate = 25;               ///< [frames/s] of an animation as it plays
  double slow_down = 1;           ///< of an animation: 4 = a quarter of the real speed
  int width = 1280;               ///< [px] of one pose
  int height = 720;               ///< [px]
  std::string view = "sagittal";
  std::string color = "activation";  ///< of imageColors()
  bool bones = true;
  bool muscles = true;
  bool markers = true;
  bool forces = true;
  bool ground = true;
  bool legend = true;
};

/// "activation", "force", "fiber_length", "none"
const std::vector<std::string>& imageColors();

/// Query parameters that an image of this kind has.
std::vector<std::string> imageParameters(ImageKind kind);

/// Value of a query parameter, nothing if absent.
using Query = std::function<std::optional<std::string>(const std::string& name)>;

/// Reads the parameters of an image. `view` is left to who knows the views.
/// @throws Error kRequestField naming the parameter and what it takes
ImageRequest parseImageRequest(ImageKind kind, const Query& query);

/// Every field that shows in the image, in a fixed order: equal for equal images.
std::string describeImage(const ImageRequest& request);

}  // namespace gaitmill::api
