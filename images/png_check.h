#pragma once
// Finds damage in PNG files by their checksums, before libpng decodes them: libpng prints a line of its own
// to stderr for damage that it meets, and OpenImageIO offers no way to stop it.

#include <string>

namespace kaustik::images {

// Why a PNG file cannot be read: it ends within a chunk, or a chunk that is needed does not match its
// checksum. Otherwise empty, also for a file without an end mark and for damaged texts, with which pictures
// are read.
std::string png_trouble(const std::string& path);

}  // namespace kaustik::images
