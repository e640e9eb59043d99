#pragma once
// Unpacks gzip files (RFC 1952) in memory.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/memory/memory_room.h"

namespace kaustik::pbrt {

// Guard against files that unpack to absurd sizes: the output may be at most kMostGzipRatio times as long as
// the file, or kFreeGzipBytes long, whichever is more. No real mesh comes close.
inline constexpr uint64_t kMostGzipRatio = 128;
inline constexpr uint64_t kFreeGzipBytes = uint64_t{64} << 20;

// Decides by the first two bytes.
bool is_gzip(std::string_view bytes);
// The unpacked bytes; nothing, with a message in `error` that names the byte, when the file is damaged, ends
// early, unpacks to more than the limits above or leaves no room for what is made of it.
std::optional<std::string> unpack_gzip(std::string_view bytes, const MemoryRoom& room, std::string& error);

}  // namespace kaustik::pbrt
