#pragma once
// Which kaustik this is; defined in a source that the build writes.

#include <string_view>

namespace kaustik {

std::string_view version();   // release, e.g. "0.1.0"
std::string_view build_id();  // `git describe --always --dirty` of the source, or "unknown"

}  // namespace kaustik
