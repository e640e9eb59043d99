// Entry point of the library that images/loaded.cpp loads.

#include "images/openimageio.h"

extern "C" [[gnu::visibility("default")]] const kaustik::render::ImageFormats* kaustik_image_formats() {
  return &kaustik::images::openimageio();
}
