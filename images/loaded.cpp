// image_formats() for programs, which load OpenImageIO when it is first needed.

#include "core/files/module_entry.h"
#include "render/picture/image_formats.h"

namespace kaustik::render {

const ImageFormats& image_formats() {
  static const ImageFormats& formats = *module_entry<const ImageFormats*()>(
      KAUSTIK_IMAGES_MODULE, "kaustik_image_formats", "which reads and writes image files other than EXR")();
  return formats;
}

}  // namespace kaustik::render
