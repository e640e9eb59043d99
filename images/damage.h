#pragma once
// Finds damage with which the libraries that decode images do not deal well, before they see it. OpenEXR and
// OpenImageIO's readers of PSD and SGI allocate what a size in a header says, gigabytes for a file of some
// bytes; libpng prints a line of its own to stderr for damage that it meets, and OpenImageIO offers no way to
// stop it.

#include <string>

namespace kaustik::images {

// Why a file of this format (see format_of()) cannot be read, or an empty text if none of that damage is
// found. PNG: up to the end of its pixels it ends within a chunk, or a chunk that is needed does not match
// its checksum. PSD: a section, or a block of resources, ends behind the file. SGI: so do its tables. EXR:
// see check_exr_header().
std::string damage_of(const std::string& path, const std::string& format);

}  // namespace kaustik::images
