// Images in every format that textures and `kaustik compare` read. Targa, which has no mark at its beginning,
// is what no other format's mark begins.

#include "render/picture/image_io.h"

#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

namespace {

// Small, so that a header that promises more costs nothing.
constexpr uint64_t kMostFuzzedPixels = uint64_t{1} << 14;

}  // namespace

void fuzz_image(Bytes input) {
  const std::string path = input_file("image.tga", as_text(input)).string();
  try {
    const render::Image image = render::read_image(path, kMostFuzzedPixels);
    if (image.pixels.size() != size_t(image.width) * size_t(image.height))
      throw Violation("a picture has another number of pixels than its size says");
  } catch (const render::ImageError&) {
  }
  std::string error;
  const auto numbers = render::image_formats().read(path, render::Channels::kAll, kMostFuzzedPixels, error);
  if (!numbers && error.empty()) throw Violation("a picture was refused without an error");
  // Textures have their own limit, which is larger: those that are too large here are only asked about.
  if (!render::image_formats().texture_trouble(path).empty() || !numbers) return;
  const auto textures = render::image_formats().make_textures();
  const ImageResult texture = textures->load(path, {}, [] { return uint64_t{1} << 30; });
  if (texture.error.empty()) textures->lookup(texture.image, {}, {0.5f, 0.25f}, {0.1f, 0}, {0, 0.1f});
}

}  // namespace kaustik::fuzz
