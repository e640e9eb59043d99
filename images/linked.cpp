// image_formats() for executables that link OpenImageIO: tests and benchmarks, where a slow start does not
// matter.

#include "images/openimageio.h"

const kaustik::render::ImageFormats& kaustik::render::image_formats() {
  return images::openimageio();
}
