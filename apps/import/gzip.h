#pragma once
// gzip files (RFC 1952), unpacked in memory.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kaustik::pbrt {

// What is unpacked may be so many times as long as the file, beyond so many bytes: a mesh never is.
inline constexpr uint64_t kMostGzipRatio = 128;
inline constexpr uint64_t kFreeGzipBytes = uint64_t{64} << 20;

// By the file's first two bytes.
bool is_gzip(std::string_view bytes);
// Nothing, with a sentence that says where in the file, when it is damaged, ends early or unpacks to too
// much.
std::optional<std::string> unpack_gzip(std::string_view bytes, std::string& error);

}  // namespace kaustik::pbrt
