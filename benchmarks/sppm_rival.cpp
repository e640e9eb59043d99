// A program that renders our scenes by stochastic progressive photon mapping of pbrt's design
// (benchmarks/sppm_rival/sppm.h).
//
//   sppm_rival SCENE.pbrt --iterations N --photons-per-iteration M --radius R -o f.exr [--width W --height H]
//     [--threads N] [--max-bounces N] [--seed N]
//
// Size and longest path default to the scene file's. Prints the wall seconds of its parts.

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/import/import_scene.h"
#include "apps/settings/scene_settings.h"
#include "benchmarks/sppm_rival/sppm.h"
#include "core/stopwatch.h"
#include "render/picture/image_io.h"

namespace kaustik::benchmarks {
namespace {

struct Options {
  std::string scene, output;
  sppm::Settings settings;
  std::optional<int> max_bounces;
  int width = 0, height = 0;
  size_t threads = 0;
};

Options parse(CLI::App& parser, int argc, char** argv) {
  Options o;
  parser.add_option("scene", o.scene)->required();
  parser.add_option("-o,--output", o.output)->required();
  parser.add_option("--iterations", o.settings.iterations)->check(CLI::PositiveNumber);
  parser.add_option("--photons-per-iteration", o.settings.photons)->check(CLI::PositiveNumber);
  parser.add_option("--radius", o.settings.radius)->check(CLI::PositiveNumber);
  parser.add_option("--max-bounces", o.max_bounces)->check(CLI::PositiveNumber);
  parser.add_option("--seed", o.settings.seed);
  parser.add_option("--width", o.width)->check(CLI::PositiveNumber);
  parser.add_option("--height", o.height)->check(CLI::PositiveNumber);
  parser.add_option("--threads", o.threads)->check(CLI::PositiveNumber);
  parser.parse(argc, argv);
  return o;
}

// If only one side is given the other keeps the aspect ratio.
void resize(const app::SceneSettings& file, const Options& o, Camera* camera) {
  const auto proportional = [](int side, int of, int to) {
    return std::max(1, int(std::lround(double(side) * to / of)));
  };
  camera->width = o.width > 0    ? o.width
                  : o.height > 0 ? proportional(o.height, file.height, file.width)
                                 : file.width;
  camera->height = o.height > 0 ? o.height : proportional(camera->width, file.width, file.height);
  if (!file.fixed_screen_window) camera->set_default_screen_window();
}

// Loads the scene, sets its size, and settles max_bounces.
Scene load(Options& o) {
  Diagnostics diagnostics;
  auto loaded = pbrt::load_scene(o.scene, diagnostics);
  if (!loaded) throw std::runtime_error(diagnostics.format_all());
  DiagnosticList ignored;
  const app::SceneSettings file = app::settings_from_scene(loaded->description, ignored);
  o.settings.max_bounces = o.max_bounces.value_or(file.settings.render.max_bounces);
  resize(file, o, &loaded->scene.camera);
  return std::move(loaded->scene);
}

void run(Options o) {
  std::optional<tbb::global_control> cap;
  if (o.threads > 0) cap.emplace(tbb::global_control::max_allowed_parallelism, o.threads);
  const Stopwatch total;
  const Scene scene = load(o);
  const accel::Bvh bvh(scene);
  const double loaded = total.seconds();
  sppm::Renderer renderer(scene, bvh, o.settings);
  const render::Image image = renderer.render();
  const double rendered = total.seconds();
  render::write_image(o.output, image);
  const sppm::Seconds& s = renderer.seconds();
  std::printf(
      "load %.3f s, iterations %.3f s (camera %.3f, grid %.3f, photons %.3f, update %.3f), total %.3f s\n",
      loaded, rendered - loaded, s.camera, s.grid, s.photons, s.update, total.seconds());
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  CLI::App parser{"Stochastic progressive photon mapping of pbrt's design"};
  try {
    kaustik::benchmarks::run(kaustik::benchmarks::parse(parser, argc, argv));
  } catch (const CLI::ParseError& e) {
    return parser.exit(e);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "sppm_rival: %s\n", e.what());
    return 1;
  }
  return 0;
}
