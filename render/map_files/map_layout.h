#pragma once
// Where the parts of a map file lie. Shared by the code that writes and that reads it.

#include <cstdint>
#include <string_view>

namespace kaustik::render {

inline constexpr std::string_view kMapMagic{"KPMAP\r\n\x1a", 8};
inline constexpr uint64_t kMapVersion = 1;
inline constexpr uint64_t kMapHeadBytes = 48;
inline constexpr uint64_t kHashBytes = 16, kHashedChunk = uint64_t{1} << 20;

// The next multiple of the alignment of arrays.
constexpr uint64_t aligned(uint64_t offset) {
  constexpr uint64_t kAlignment = 4096;
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}
constexpr uint64_t chunks_of(uint64_t bytes) {
  return (bytes + kHashedChunk - 1) / kHashedChunk;
}

}  // namespace kaustik::render
