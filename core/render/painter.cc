#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/render/camera.h"
#include "core/render/color_scale.h"
#include "core/render/encoders.h"
#include "core/render/legend.h"
#include "core/render/picture.h"
#include "core/render/picture_limits.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"
#include "core/render/subject.h"

namespace gaitmill {

namespace {

// Instants at which the body's extent is looked at. A stride moves smoothly between two of them.
constexpr int kOutlineInstants = 24;
constexpr double kFloorRadius = 2.4;  // [m]
// Radius of the thinnest muscle [px]: less would come and go between samples.
constexpr double kThinnest = 0.75;
// Share of a strip's pose that its floor fills, so that neighbours do not meet at an edge.
constexpr double kStripFloorShare = 0.98;

bool isSame(const TimeSeries& a, const TimeSeries& b) {
  return a.labels == b.labels && a.time == b.time && a.values.rows() == b.values.rows() &&
         a.values.cols() == b.values.cols() &&
         std::equal(a.values.data(), a.values.data() + a.values.size(), b.values.data());
}

// Percentage of the cycle, if one is known.
std::optional<double> findPercent(const PictureData& data, double time) {
  if (!data.cycle || data.cycle->end <= data.cycle->start) return std::nullopt;
  return 100 * (time - data.cycle->start) / (data.cycle->end - data.cycle->start);
}

LegendContent describe(const PictureData& data, const PictureOptions& options) {
  LegendContent content;
  const bool coloured =
      options.muscles && options.color != MuscleColor::kNone && data.muscle_values.rowCount() > 0;
  if (coloured) content.scale = &getColorScale(options.color);
  content.forces = options.forces && data.ground_reactions.rowCount() > 0;
  content.measured_markers = options.markers && data.markers.rowCount() > 0;
  content.model_markers = options.markers;
  return content;
}

std::vector<std::string> describeInstant(const PictureData& data, double time) {
  std::vector<std::string> lines;
  if (data.kinematics.rowCount() == 0) return lines;
  lines.push_back(formatFixed(time, 3) + " s");
  if (const std::optional<double> percent = findPercent(data, time)) {
    lines.push_back(formatFixed(*percent, 0) + " % of gait cycle");
  }
  return lines;
}

double clampTime(const TimeSeries& kinematics, double time) {
  if (kinematics.rowCount() == 0) return time;
  return std::clamp(time, kinematics.time.front(), kinematics.time.back());
}

}  // namespace

struct Painter::Impl {
  std::string geometry_folder;
  std::string model_osim;
  std::unique_ptr<Subject> subject;
  std::unique_ptr<Renderer> renderer;
  TimeSeries outlined;                   // motion that `outline` belongs to
  std::vector<Eigen::Vector3f> outline;  // of all poses, see collectOutline
  Surface figure, floor;

  // Model, bones and renderer of the last picture where they fit this one.
  void prepare(const PictureData& data) {
    if (!renderer) renderer = std::make_unique<Renderer>();
    if (!subject || data.model_osim != model_osim) {
      subject.reset();
      outline.clear();
      subject = std::make_unique<Subject>(data.model_osim, geometry_folder);
      model_osim = data.model_osim;
    }
    if (!outline.empty() && isSame(outlined, data.kinematics)) return;
    outline.clear();
    const TimeSeries& motion = data.kinematics;
    const int last = std::min(kOutlineInstants, std::max(1, motion.rowCount())) - 1;
    for (int i = 0; i <= last; ++i) {
      const double share = last > 0 ? static_cast<double>(i) / last : 0;
      const double time =
          motion.rowCount() > 0
              ? motion.time.front() + share * (motion.time.back() - motion.time.front())
              : 0;
      try {
        subject->setPose(motion, time);
      } catch (const Error&) {
        continue;  // a gap in the motion; who asks for a picture of it is told
      }
      collectOutline(*subject, subject->findFollowPoint(), outline);
    }
    outlined = motion;
  }

  // One pose into a region of an image.
  void drawPose(const PictureData& data,
                double time,
                const PictureOptions& options,
                const Framing& framing,
                const Frame& frame,
                const FloorStyle& floor_style,
                const Region& region,
                Image& image) {
    subject->setPose(data.kinematics, time);
    figure.clear();
    floor.clear();
    const double pixel = framing.distance / findFocalLength(frame);
    makeFigure(*subject, data, time, options, kThinnest * pixel, figure);
    if (options.ground) makeFloor(*subject, floor_style, floor);
    const Camera camera = makeCamera(options.view, framing, frame, subject->findFollowPoint());
    renderer->draw(floor, figure, camera, region, image);
  }

  void drawSingle(const PictureData& data,
                  double time,
                  const PictureOptions& options,
                  Image& image) {
    LegendContent content = describe(data, options);
    if (options.legend) {
      content.instant = describeInstant(data, time);
    } else {
      content = {};
    }
    const Layout layout = makeLayout(options.width, options.height, content, false);
    const Framing framing = fitFraming(outline, options.view, layout.body);
    const Region region{0, 0, options.width, options.height};
    drawPose(data, time, options, framing, layout.body, {kFloorRadius, 0.5}, region, image);
    drawLegend(content, layout, findPixelsPerNewton(framing, layout.body), image);
  }

  static double findPixelsPerNewton(const Framing& framing, const Frame& frame) {
    return kArrowLengthPerForce * findFocalLength(frame) / framing.distance;
  }
};

Painter::Painter(std::string geometry_folder) : impl_(std::make_unique<Impl>()) {
  impl_->geometry_folder = std::move(geometry_folder);
}

Painter::~Painter() = default;

Picture Painter::paintPose(const PictureData& data, double time, const PictureOptions& options) {
  validateOptions(options);
  require(std::isfinite(time), ErrorCode::kRequestField, "the time of a picture must be a number");
  impl_->prepare(data);
  Image image(options.width, options.height);
  impl_->drawSingle(data, clampTime(data.kinematics, time), options, image);
  return {"image/png", encodePng(image)};
}

Picture Painter::paintStrip(
    const PictureData& data, double start, double end, int count, const PictureOptions& options) {
  validateStrip(start, end, count, options);
  Impl& s = *impl_;
  s.prepare(data);
  Image image(count * options.width, options.height);
  const LegendContent content = options.legend ? describe(data, options) : LegendContent{};
  Layout layout = makeLayout(image.width, image.height, content, true);
  const double cap = layout.cap_height;
  const double margin = 0.03 * std::min(options.width, options.height);
  const double label_base = layout.body.bottom - 0.4 * cap;
  const bool labelled = options.legend && label_base > 0.5 * image.height;
  const double bottom = labelled ? label_base - 2.5 * cap : layout.body.bottom;
  const Frame frame{margin, layout.body.top, options.width - margin, bottom};
  const Framing framing = fitFraming(s.outline, options.view, frame);
  const Camera camera = makeCamera(options.view, framing, frame, Eigen::Vector3d::Zero());
  const double half_width = 0.5 * options.width * framing.distance / findFocalLength(frame);
  const FloorStyle floor_style{std::min(kFloorRadius, kStripFloorShare * half_width),
                               0,
                               1.3 * half_width * camera.R_CG.row(0).transpose()};
  for (int pose = 0; pose < count; ++pose) {
    const double share = count > 1 ? static_cast<double>(pose) / (count - 1) : 0;
    const double time = clampTime(data.kinematics, start + share * (end - start));
    const Region region{pose * options.width, 0, options.width, options.height};
    s.drawPose(data, time, options, framing, frame, floor_style, region, image);
  }
  for (int pose = 0; labelled && pose < count; ++pose) {
    const double share = count > 1 ? static_cast<double>(pose) / (count - 1) : 0;
    const double percent = findPercent(data, start + share * (end - start)).value_or(100 * share);
    drawLabel(formatFixed(percent, 0) + " %",
              {(pose + 0.5) * options.width, label_base},
              1.1 * cap,
              image);
  }
  drawLegend(content, layout, Impl::findPixelsPerNewton(framing, frame), image);
  return {"image/png", encodePng(image)};
}

Picture Painter::paintAnimation(const PictureData& data,
                                double start,
                                double end,
                                double rate,
                                double slow_down,
                                const PictureOptions& options) {
  const int frames = countFrames(start, end, rate, slow_down, options);
  impl_->prepare(data);
  WebpAnimation animation(options.width, options.height, 1000 / rate);
  Image image(options.width, options.height);
  for (int frame = 0; frame < frames; ++frame) {
    // The last frame ends where the first begins, so that a cycle repeats without a halt.
    const double time = start + (end - start) * frame / frames;
    impl_->drawSingle(data, clampTime(data.kinematics, time), options, image);
    animation.addFrame(image);
  }
  return {"image/webp", animation.finish()};
}

}  // namespace gaitmill
