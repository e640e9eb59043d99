#pragma once
// Writing OpenEXR files, by OpenEXR's own library: the format that needs no OpenImageIO (see
// image_formats.h).

#include <string>
#include <vector>

#include "render/picture/image_formats.h"

namespace kaustik::render {

struct ExrPicture {
  std::vector<std::string> channels;
  int x0 = 0, y0 = 0, width = 0, height = 0;  // the data window
  int full_width = 0, full_height = 0;        // the display window, from (0, 0)
  bool zip = true;                            // else run lengths
  const float* values = nullptr;              // row by row, the channels of a pixel beside each other
};

// 32-bit floats, string attributes, no time of day: the same picture gives the same bytes. Makes no threads.
// Throws std::exception; what it left of the file is the caller's to remove.
void write_exr_file(const std::string& path, const ExrPicture& picture, const Metadata& attributes);

}  // namespace kaustik::render
