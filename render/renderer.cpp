// render(): the order of a render. Shoot, build, tiles.

#include "render/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <stdexcept>

#include "render/photon_maps.h"
#include "render/tiles.h"

namespace kaustik::render {

namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}

void check_settings(const RenderSettings& s, const PerspectiveCamera& camera) {
  require(camera.width > 0 && camera.height > 0, "the image has no pixels");
  require(s.spp >= 1, "spp must be at least 1");
  require(s.max_bounces >= 1, "max_bounces must be at least 1");
  require(!s.radius || (*s.radius > 0 && std::isfinite(*s.radius)), "radius must be positive and finite");
  require(s.cone_k >= 1, "cone_k must be at least 1");
  if (s.crop.empty()) return;
  const bool inside =
      s.crop.x0 >= 0 && s.crop.y0 >= 0 && s.crop.x1 <= camera.width && s.crop.y1 <= camera.height;
  require(inside, fmt::format("crop {} {} {} {} lies outside the image of {} x {} pixels", s.crop.x0,
                              s.crop.x1, s.crop.y0, s.crop.y1, camera.width, camera.height));
}

FilmSums make_film(const CropWindow& crop, const PerspectiveCamera& camera) {
  if (crop.empty()) return FilmSums(camera.width, camera.height);
  return FilmSums(crop.x1 - crop.x0, crop.y1 - crop.y0, crop.x0, crop.y0, camera.width, camera.height);
}

// One caller at a time.
ProgressCallback serialised(const ProgressCallback& progress) {
  if (!progress) return {};
  return [&progress, mutex = std::make_shared<std::mutex>()](const Progress& p) {
    const std::lock_guard lock(*mutex);
    return progress(p);
  };
}

bool render_pass(const RenderContext& ctx, const ProgressCallback& progress, FilmSums* film,
                 RenderStatistics* statistics) {
  const auto start = std::chrono::steady_clock::now();
  const bool finished = render_tiles(ctx, progress, film, statistics);
  statistics->render_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  statistics->passes += finished;
  return finished;
}

}  // namespace

RayCounters& RayCounters::operator+=(const RayCounters& o) {
  camera += o.camera;
  specular += o.specular;
  shadow += o.shadow;
  bounce += o.bounce;
  return *this;
}

LectureCounters& LectureCounters::operator+=(const LectureCounters& o) {
  from_photons += o.from_photons;
  climbed += o.climbed;
  fallback_few += o.fallback_few;
  fallback_shadow += o.fallback_shadow;
  fallback_face += o.fallback_face;
  return *this;
}

RenderResult render(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                    const ProgressCallback& callback) {
  check_settings(settings, scene.camera);
  const ProgressCallback progress = serialised(callback);
  RenderResult result;
  RenderStatistics& statistics = result.statistics;
  result.plan = make_plan(settings, scene.needs);
  const uint64_t passes = choose_passes(scene, bvh, settings, &result.plan);
  FilmSums film = make_film(settings.crop, scene.camera);
  PhotonMaps maps;
  for (uint64_t p = 0; p < passes && !result.cancelled; ++p) {
    const PassRange pass = pass_range(p, passes, settings.photons, settings.spp);
    const RenderContext ctx{scene, bvh, settings, result.plan, maps, pass};
    result.cancelled =
        !make_photon_maps(scene, bvh, settings, result.plan, pass, progress, &maps, &statistics) ||
        !render_pass(ctx, progress, &film, &statistics);
  }
  result.film = mean_of(film);
  return result;
}

}  // namespace kaustik::render
