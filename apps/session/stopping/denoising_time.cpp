#include "apps/session/stopping/denoising_time.h"

#include "core/math/hash.h"
#include "core/stopwatch.h"
#include "render/camera/pixel_range.h"
#include "render/denoise/denoise.h"

namespace kaustik::app {

double denoising_seconds(const render::RenderSettings& settings, const Camera& camera) {
  if (!settings.denoise.value_or(false)) return 0;
  constexpr int kSide = 64;  // of a square of random numbers
  render::Film film(kSide, kSide);
  render::HalfFilm halves(kSide, kSide);
  uint64_t drawn = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      render::HalfMeans& pixel = halves.at(x, y);
      pixel.share = {0.5f, 0.5f};
      for (auto& half : pixel.mean)
        for (float& channel : half) channel = float(mix64(++drawn) >> 40) * 0x1p-24f;
    }
  const Stopwatch watch;
  render::denoise(film, halves);
  const uint64_t pixels = render::rendered_range(settings.crop, camera).pixels();
  return watch.seconds() * double(pixels) / (kSide * kSide);
}

}  // namespace kaustik::app
