#include "apps/sweep/pictures.h"

#include "render/compare/compare.h"
#include "render/picture/image_io.h"
#include "render/picture/shrink.h"

namespace kaustik::app {

void write_picture(const std::string& path, const render::Image& image, const render::ToneSettings& tone) {
  render::write_image(path, render::shrunk(image, kPictureSide), tone);
}

void write_error_map(const std::string& path, const render::Image& reference, const render::Image& image) {
  const render::Image error = render::shrunk(render::relative_error(reference, image), kPictureSide);
  render::write_image(path, render::false_colours(error));
}

}  // namespace kaustik::app
