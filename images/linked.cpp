// Linked into the program itself: for tests and benchmarks, which may start slowly.

#include "images/openimageio.h"

const kaustik::render::ImageFormats& kaustik::render::image_formats() {
  return images::openimageio();
}
