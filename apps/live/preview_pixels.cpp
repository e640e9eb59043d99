#include "apps/live/preview_pixels.h"

#include <cmath>

#include "render/picture/exposure.h"
#include "render/picture/shrink.h"

namespace kaustik::app {

PreviewPixels::PreviewPixels(const LivePicture& picture, const ToneChoice& tone)
    : live_(picture),
      tone_(tone),
      channels_(live_channels(tone.exposure ? std::vector<std::string>{}
                                            : std::vector<std::string>{"emitted", "denoising_emitted"})),
      picture_(picture.range().width(), picture.range().height()),
      lights_(tone.exposure ? render::Image() : picture_) {}

bool PreviewPixels::update() {
  const LivePicture::Changes changes = live_.changed_since(version_);
  for (const render::PixelRange& tile : changes.tiles) read(tile);
  version_ = changes.version;
  return !changes.tiles.empty();
}

void PreviewPixels::read(const render::PixelRange& tile) {
  std::vector<float> values(tile.pixels() * channels_.size());
  live_.read(tile, channels_, values.data());
  const float* value = values.data();
  const auto next = [&] {
    const Rgb rgb(value[0], value[1], value[2]);
    value += 3;
    return std::isfinite(rgb.x + rgb.y + rgb.z) ? rgb : Rgb(0);
  };
  const render::PixelRange& all = live_.range();
  for (int y = tile.y0 - all.y0; y < tile.y1 - all.y0; ++y)
    for (int x = tile.x0 - all.x0; x < tile.x1 - all.x0; ++x) {
      picture_.at(x, y) = next();
      if (tone_.exposure) continue;
      const Rgb emitted = next();
      lights_.at(x, y) = emitted - next();
    }
}

Pixels8 PreviewPixels::shown(int width, int height) const {
  const float stops =
      tone_.exposure ? *tone_.exposure : render::automatic_exposure(picture_, lights_, tone_.tonemap);
  const render::Image small = render::shrunk_to(picture_, width, height);
  Pixels8 pixels(width, height);
  for (size_t i = 0; i < pixels.colours.size(); ++i)
    pixels.colours[i] = render::to_srgb8(small.pixels[i], {stops, tone_.tonemap});
  return pixels;
}

}  // namespace kaustik::app
