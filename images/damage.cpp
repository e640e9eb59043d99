// Walks through the parts of files whose sizes or checksums are checked.

#include "images/damage.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "render/picture/exr_header.h"

namespace kaustik::images {

namespace {

constexpr const char* kCut = "it ends early";

// The next bytes of the file; nothing if it ends before.
template <size_t N>
std::optional<std::array<unsigned char, N>> next(std::istream& file) {
  std::array<unsigned char, N> bytes{};
  if (!file.read(reinterpret_cast<char*>(bytes.data()), N)) return std::nullopt;
  return bytes;
}

uint32_t big_endian(const unsigned char* bytes) {
  uint32_t out = 0;
  for (int i = 0; i < 4; ++i) out = out << 8 | bytes[i];
  return out;
}

uint32_t little_endian(const unsigned char* bytes) {
  uint32_t out = 0;
  for (int i = 3; i >= 0; --i) out = out << 8 | bytes[i];
  return out;
}

// The checksum of the name, which has been read, and of the data, which follow; nothing if the file ends
// before.
std::optional<uint32_t> checksum(std::istream& file, const unsigned char* name, uint64_t size) {
  constexpr uint64_t kBlock = 1 << 16;
  std::vector<unsigned char> block(std::min(size, kBlock));
  uLong sum = crc32(0, name, 4);
  for (; size > 0; size -= block.size()) {
    block.resize(std::min(size, kBlock));
    if (!file.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size())))
      return std::nullopt;
    sum = crc32(sum, block.data(), static_cast<uInt>(block.size()));
  }
  return static_cast<uint32_t>(sum);
}

// Small letters begin the names of chunks that readers may pass over.
bool is_needed(unsigned char first_letter) {
  return (first_letter & 0x20) == 0;
}

// A PNG file is a list of chunks: the size of the data in four bytes (big-endian), a name of four letters,
// the data, and the checksum of name and data.
std::string png_trouble(const std::string& path, Reads reads) {
  constexpr std::streamoff kMarkBytes = 8;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kMarkBytes);
  for (bool any_pixels = false;;) {
    const std::streamoff at = file.tellg();
    const auto head = next<8>(file);
    if (!head) return any_pixels ? "" : kCut;
    const unsigned char* const name = head->data() + 4;
    const bool pixels = std::equal(name, name + 4, "IDAT");
    if ((any_pixels && !pixels) || (pixels && reads == Reads::kHeader)) return {};
    any_pixels = pixels;
    const auto sum = checksum(file, name, big_endian(head->data()));
    const auto stored = next<4>(file);
    if (!sum || !stored) return kCut;
    if (is_needed(*name) && *sum != big_endian(stored->data()))
      return fmt::format("it is damaged: its chunk at byte {} does not match its checksum", at);
  }
}

std::string exr_trouble(const std::string& path) {
  try {
    render::check_exr_header(path);
  } catch (const std::runtime_error& failure) {
    return failure.what();
  }
  return {};
}

// The header of a BMP file has numbers of four bytes (little-endian): its size, the width, the height, which
// is negative if the first row is the upper one, planes and bits, and how pixels are encoded. In runs of 8 or
// 4 bits, two bytes stand for up to 255 pixels.
std::string bmp_trouble(const std::string& path) {
  constexpr std::streamoff kMarkBytes = 14;
  constexpr int32_t kRunsOf8 = 1, kRunsOf4 = 2;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kMarkBytes);
  const auto head = next<20>(file);
  const auto number = [&](size_t i) { return static_cast<int32_t>(little_endian(head->data() + 4 * i)); };
  if (!head || little_endian(head->data()) < head->size()) return {};
  if (number(4) != kRunsOf8 && number(4) != kRunsOf4) return {};
  const int64_t pixels = std::abs(int64_t{number(1)} * number(2));
  std::error_code none;
  const uintmax_t bytes = std::filesystem::file_size(path, none);
  return !none && static_cast<uintmax_t>(pixels) / 128 > bytes ? kCut : "";
}

}  // namespace

std::string damage_of(const std::string& path, const std::string& format, Reads reads) {
  if (format == "png") return png_trouble(path, reads);
  if (format == "bmp") return bmp_trouble(path);
  return format == "openexr" ? exr_trouble(path) : "";
}

}  // namespace kaustik::images
