#pragma once
// render::ImageFormats implemented with OpenImageIO.

#include "render/picture/image_formats.h"

namespace kaustik::images {

// The only instance in the process.
const render::ImageFormats& openimageio();

}  // namespace kaustik::images
