#pragma once
// Version of this build; defined in a source file that the build generates.

#include <string_view>

namespace kaustik {

std::string_view version();   // release, e.g. "0.1.0"
std::string_view build_id();  // `git describe --always --dirty` of the source, or "unknown"

}  // namespace kaustik
