#pragma once
// Finds damage with which the libraries that decode images do not deal well, before they see it. OpenEXR
// allocates what a size in a header says, gigabytes for a file of some bytes, and so does OpenImageIO for
// runs of pixels in BMP files; libpng prints a line of its own to stderr for damage that it meets, and
// OpenImageIO offers no way to stop it.

#include <string>

namespace kaustik::images {

// What of a file is to be read: its header, or its pixels, too.
enum class Reads { kHeader, kPixels };

// Why a file of this format (see format_of()) cannot be read, or an empty text if none of that damage is
// found. PNG: up to the end of what is read it ends within a chunk, or a chunk that is needed does not match
// its checksum. EXR: see check_exr_header(). BMP: it has fewer bytes than its pixels need as the longest
// runs.
std::string damage_of(const std::string& path, const std::string& format, Reads reads);

}  // namespace kaustik::images
