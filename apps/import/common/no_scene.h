#pragma once
// Files that are given as scenes and are none.

#include <string>
#include <string_view>

#include "core/files/read_root.h"

namespace kaustik {

// What the file is instead of a scene, and what takes such files, from its first bytes: a picture or a
// partial result. Empty for others.
std::string why_no_scene(std::string_view bytes);

// The same for a file; empty, too, if it cannot be read.
std::string why_no_scene_in(const ReadableFile& file);

// Whether bytes that should be a text are something else: of the first 4096, at least eight, and more than
// one in thirty-two, are control characters that no text has.
bool is_binary(std::string_view bytes);

}  // namespace kaustik
