#pragma once
// The image formats by OpenImageIO.

#include "render/picture/image_formats.h"

namespace kaustik::images {

// One for the process.
const render::ImageFormats& openimageio();

}  // namespace kaustik::images
