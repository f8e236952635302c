// Pictures of the project's model with 80 muscles at 1280 x 720, whole and by part. One core:
//   LP_NUM_THREADS=0 taskset -c 0 build/release/tests/gaitmill_bench --benchmark_filter=render
#include <unistd.h>

#include <cstdio>

#include <benchmark/benchmark.h>

#include "core/render/camera.h"
#include "core/render/encoders.h"
#include "core/render/legend.h"
#include "core/render/renderer.h"
#include "core/render/scene.h"
#include "core/render/subject.h"
#include "tests/support/stride_picture.h"

namespace gaitmill {
namespace {

constexpr Region kRegion{0, 0, 1280, 720};

double findResidentMegabytes() {
  long total = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file != nullptr) {
    if (std::fscanf(file, "%ld %ld", &total, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

struct Bench {
  PictureData data = makeStridePicture();
  Subject subject{data.model_osim, ""};
  PictureOptions options;
  Framing framing;
  Frame frame{240, 20, 1040, 700};
  Camera camera;
  Surface figure, floor;

  Bench() {
    activateSoleus(subject.model().spec(), data);
    subject.setPose(data.kinematics, 0);
    std::vector<Eigen::Vector3f> outline;
    collectOutline(subject, subject.findFollowPoint(), outline);
    framing = fitFraming(outline, options.view, frame);
    camera = makeCamera(options.view, framing, frame, subject.findFollowPoint());
    makeFigure(subject, data, 0, options, 0, figure);
    makeFloor(subject, {}, floor);
  }
};

void renderPose(benchmark::State& run) {
  Bench b;
  Painter painter;
  b.options.width = static_cast<int>(run.range(0));
  b.options.height = b.options.width * 9 / 16;
  std::size_t bytes = painter.paintPose(b.data, 0, b.options).bytes.size();
  double time = 0;
  for (auto step : run) bytes = painter.paintPose(b.data, time += 0.001, b.options).bytes.size();
  run.counters["png_kB"] = static_cast<double>(bytes) / 1e3;
  run.counters["resident_MB"] = findResidentMegabytes();
}
BENCHMARK(renderPose)->Arg(1280)->Arg(640)->Arg(400)->Unit(benchmark::kMillisecond);

void renderScene(benchmark::State& run) {
  Bench b;
  for (auto step : run) {
    b.subject.setPose(b.data.kinematics, 0);
    b.figure.clear();
    makeFigure(b.subject, b.data, 0, b.options, 0, b.figure);
  }
  run.counters["triangles"] = static_cast<double>(b.figure.indices.size()) / 3;
}
BENCHMARK(renderScene)->Unit(benchmark::kMillisecond);

void renderFloor(benchmark::State& run) {
  Bench b;
  for (auto step : run) {
    b.floor.clear();
    makeFloor(b.subject, {}, b.floor);
  }
}
BENCHMARK(renderFloor)->Unit(benchmark::kMillisecond);

// 0 nothing but the background, 1 with the floor, 2 with the figure too.
void renderRaster(benchmark::State& run) {
  Bench b;
  Renderer renderer;
  Image image(kRegion.width, kRegion.height);
  const Surface none;
  const Surface& floor = run.range(0) >= 1 ? b.floor : none;
  const Surface& figure = run.range(0) >= 2 ? b.figure : none;
  renderer.draw(floor, figure, b.camera, kRegion, image);
  for (auto step : run) renderer.draw(floor, figure, b.camera, kRegion, image);
}
BENCHMARK(renderRaster)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

Image drawImage(const Bench& b) {
  Renderer renderer;
  Image image(kRegion.width, kRegion.height);
  renderer.draw(b.floor, b.figure, b.camera, kRegion, image);
  return image;
}

void renderLegend(benchmark::State& run) {
  LegendContent content;
  content.instant = {"0.620 s", "37 % of gait cycle"};
  content.scale = &getColorScale(MuscleColor::kActivation);
  content.forces = content.measured_markers = content.model_markers = true;
  Image image(kRegion.width, kRegion.height);
  const Layout layout = makeLayout(image.width, image.height, content, false);
  for (auto step : run) drawLegend(content, layout, 0.2, image);
}
BENCHMARK(renderLegend)->Unit(benchmark::kMillisecond);

void renderPng(benchmark::State& run) {
  const Image image = drawImage(Bench());
  for (auto step : run) benchmark::DoNotOptimize(encodePng(image));
}
BENCHMARK(renderPng)->Unit(benchmark::kMillisecond);

void renderWebpFrame(benchmark::State& run) {
  const Image image = drawImage(Bench());
  WebpAnimation animation(image.width, image.height, 40);
  for (auto step : run) animation.addFrame(image);
}
BENCHMARK(renderWebpFrame)->Unit(benchmark::kMillisecond)->Iterations(20);

}  // namespace
}  // namespace gaitmill
