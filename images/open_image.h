#pragma once
// Opens image files by their first bytes.

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

#include "images/damage.h"

namespace kaustik::images {

// OpenImageIO's name of the format that a file begins as, such as "png"; empty for all formats but those that
// pictures and textures come in. The others are refused unopened: some of OpenImageIO's readers, that of FITS
// among them, end the process on damaged files, and OpenImageIO's own search tries them all. Targa has no
// mark at its beginning and is known by its extension.
std::string format_of(const std::string& path);

// Opens an image for reading, with colours that are not multiplied by alpha unless they are stored so, and
// without threads. On failure returns null and sets `error` to the reason.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path, Reads reads,
                                             OIIO::ImageSpec configuration, std::string& error);

// Reads the channels from `first` to before `end`, those of pixels `stride` bytes apart. Returns false and
// sets `error` if the reader fails or throws, as those of some formats do for damaged files.
bool read_channels(OIIO::ImageInput& in, int first, int end, float* values, OIIO::stride_t stride,
                   std::string& error);

}  // namespace kaustik::images
