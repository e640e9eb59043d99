#include "apps/session/stopping/denoising_time.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/math/hash.h"
#include "core/stopwatch.h"
#include "render/camera/pixel_range.h"
#include "render/denoise/denoise.h"

namespace kaustik::app {

namespace {

// Random halves of a picture of this size. Its right half is without texture and flat, as parts of most
// pictures are: there the filter is faster.
render::HalfFilm random_halves(int width, int height) {
  constexpr size_t kFirst = render::half_of(render::Layer::kDenoisingAlbedo),
                   kEnd = render::half_of(render::Layer::kDenoisingDepth);
  render::HalfFilm halves(width, height);
  uint64_t drawn = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      render::HalfMeans& pixel = halves.at(x, y);
      pixel.share = {0.5f, 0.5f};
      for (auto& half : pixel.mean)
        for (size_t channel = 0; channel < half.size(); ++channel) {
          const bool flat = x >= width / 2 && channel >= kFirst && channel < kEnd;
          half[channel] = flat ? 0.5f : float(mix64(++drawn) >> 40) * 0x1p-24f;
        }
    }
  return halves;
}

double denoising_seconds(const render::RenderSettings& settings, const Camera& camera) {
  constexpr int kWidth = 128, kRowsOfThread = 32;
  const int height = kRowsOfThread * std::clamp(tbb::this_task_arena::max_concurrency(), 1, 64);
  const render::Film film(kWidth, height);
  const render::HalfFilm halves = random_halves(kWidth, height);
  const Stopwatch watch;
  render::denoise(film, halves);
  const uint64_t pixels = render::rendered_range(settings.crop, camera).pixels();
  return watch.seconds() * double(pixels) / (kWidth * height);
}

}  // namespace

double settle_timed_denoising(const Camera& camera, const Console& console, Settings* settings) {
  constexpr double kMost = 0.25;  // of the time
  std::optional<bool>& denoise = settings->render.denoise;
  if (!settings->stop.seconds || !denoise.value_or(true)) return 0;
  const double seconds = denoising_seconds(settings->render, camera);
  if (denoise || seconds <= kMost * *settings->stop.seconds) {
    denoise = true;
    return seconds;
  }
  denoise = false;
  console.note(fmt::format("the picture is not denoised: that would take {:.2g} s of the time", seconds));
  return 0;
}

}  // namespace kaustik::app
