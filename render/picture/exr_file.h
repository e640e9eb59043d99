#pragma once
// Writes and reads OpenEXR files with OpenEXR's own library, so that this format does not need OpenImageIO
// (see image_formats.h).

#include <string>
#include <vector>

#include "core/files/pending_file.h"
#include "render/picture/image_formats.h"

namespace kaustik::render {

struct ExrPicture {
  std::vector<std::string> channels;
  int x0 = 0, y0 = 0, width = 0, height = 0;  // the data window
  int full_width = 0, full_height = 0;        // the display window, from (0, 0)
  bool zip = true;                            // true: ZIP compression; false: run lengths
  const float* values = nullptr;              // row by row, the channels of a pixel interleaved
};

// Writes 32-bit floats and string attributes but no date, so the same picture gives the same bytes. Makes no
// threads. Does not commit the file. Throws std::exception on failure.
void write_exr_file(PendingFile& file, const ExrPicture& picture, const Metadata& attributes);

// All channels of a file's first part, converted to 32-bit floats.
struct ExrChannels {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // the data window, counted from the display window's corner
  int full_width = 0, full_height = 0;        // the display window's size
  std::vector<std::string> names{};
  std::vector<std::vector<float>> values{};  // of each channel, row by row

  // The values of a channel; null if the file does not have it.
  const std::vector<float>* find(const std::string& name) const;
};

// Throws std::exception for files that cannot be read, have subsampled channels, or whose data window has
// more than most_pixels.
ExrChannels read_exr_file(const std::string& path, uint64_t most_pixels);

}  // namespace kaustik::render
