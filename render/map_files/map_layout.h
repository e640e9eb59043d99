#pragma once
// Where the parts of a map file lie. Shared by the code that writes and that reads it.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/files/content_hash.h"

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

// Chunk i of an array.
inline std::span<const std::byte> chunk_of(std::span<const std::byte> array, uint64_t i) {
  const uint64_t begin = i * kHashedChunk;
  return array.subspan(begin, std::min<uint64_t>(kHashedChunk, array.size() - begin));
}
inline std::array<uint64_t, 2> hash_of(std::span<const std::byte> bytes) {
  ContentHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.words();
}

}  // namespace kaustik::render
