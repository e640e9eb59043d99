#pragma once
// Unpacks gzip files (RFC 1952) in memory.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kaustik::pbrt {

// Guard against files that unpack to absurd sizes: the output may be at most kMostGzipRatio times as long as
// the file, or kFreeGzipBytes long, whichever is more. No real mesh comes close.
inline constexpr uint64_t kMostGzipRatio = 128;
inline constexpr uint64_t kFreeGzipBytes = uint64_t{64} << 20;

// Decides by the first two bytes.
bool is_gzip(std::string_view bytes);
// The unpacked bytes; nothing, with a message in `error` that names the byte, when the file is damaged, ends
// early or unpacks to more than the limits above.
std::optional<std::string> unpack_gzip(std::string_view bytes, std::string& error);

}  // namespace kaustik::pbrt
