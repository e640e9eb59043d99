// Walks through the parts of files whose sizes or checksums are checked.

#include "images/damage.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
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
std::string png_trouble(const std::string& path) {
  constexpr std::streamoff kMarkBytes = 8;
  std::ifstream file(path, std::ios::binary);
  file.seekg(kMarkBytes);
  for (bool any_pixels = false; file.peek() != std::ifstream::traits_type::eof();) {
    const std::streamoff at = file.tellg();
    const auto head = next<8>(file);
    if (!head) return any_pixels ? "" : kCut;
    const unsigned char* const name = head->data() + 4;
    const bool pixels = std::equal(name, name + 4, "IDAT");
    if (any_pixels && !pixels) break;
    any_pixels = pixels;
    const auto sum = checksum(file, name, big_endian(head->data()));
    const auto stored = next<4>(file);
    if (!sum || !stored) return kCut;
    if (is_needed(*name) && *sum != big_endian(stored->data()))
      return fmt::format("it is damaged: its chunk at byte {} does not match its checksum", at);
  }
  return {};
}

// Passes the blocks of resources before `end` in a PSD file: mark, number, name, which is padded to an even
// size with its length, and data. Returns whether they end there or before.
bool resources_end(std::istream& file, std::streamoff end) {
  while (file.tellg() < end) {
    const auto head = next<7>(file);
    if (!head) return false;
    file.ignore(head->back() | 1);
    const auto size = next<4>(file);
    if (!size || big_endian(size->data()) > end - file.tellg()) return false;
    file.ignore((uint64_t{big_endian(size->data())} + 1) & ~uint64_t{1});
  }
  return true;
}

// In a PSD file three sections follow the header, each behind its size: colours, resources, layers. Files of
// version 2 are larger, with eight bytes for the last size.
std::string psd_trouble(const std::string& path) {
  constexpr std::streamoff kVersion = 4, kHeaderBytes = 26;
  std::error_code unknown;
  const auto file_size = static_cast<std::streamoff>(std::filesystem::file_size(path, unknown));
  std::ifstream file(path, std::ios::binary);
  file.seekg(kVersion);
  const auto version = next<2>(file);
  file.seekg(kHeaderBytes);
  for (const bool resources : {false, true}) {
    const auto size = next<4>(file);
    if (!size || big_endian(size->data()) > file_size - file.tellg()) return kCut;
    const std::streamoff end = file.tellg() + std::streamoff{big_endian(size->data())};
    if (resources && !resources_end(file, end))
      return "it is damaged: its resources end behind their section";
    file.seekg(end);
  }
  const bool large = version && version->back() == 2;
  const auto upper = large ? next<4>(file) : std::array<unsigned char, 4>{};
  const auto lower = next<4>(file);
  const bool fits = upper && lower &&
                    (uint64_t{big_endian(upper->data())} << 32 | big_endian(lower->data())) <=
                        static_cast<uint64_t>(file_size - file.tellg());
  return fits ? "" : kCut;
}

// In an SGI file of run lengths two tables follow the header, each with four bytes for every row of every
// channel.
std::string sgi_trouble(const std::string& path) {
  constexpr uint64_t kHeaderBytes = 512;
  constexpr unsigned char kRunLengths = 1;
  std::error_code unknown;
  std::ifstream file(path, std::ios::binary);
  const auto head = next<12>(file);  // mark, storage, bytes of a number, dimensions, width, height, channels
  if (!head) return kCut;
  const auto number = [&](size_t at) { return uint64_t{(*head)[at]} << 8 | (*head)[at + 1]; };
  const uint64_t tables = 8 * number(8) * number(10);
  const bool fits = kHeaderBytes + tables <= std::filesystem::file_size(path, unknown);
  return (*head)[2] != kRunLengths || fits ? "" : kCut;
}

std::string exr_trouble(const std::string& path) {
  try {
    render::check_exr_header(path);
  } catch (const std::runtime_error& failure) {
    return failure.what();
  }
  return {};
}

}  // namespace

std::string damage_of(const std::string& path, const std::string& format) {
  if (format == "png") return png_trouble(path);
  if (format == "psd") return psd_trouble(path);
  if (format == "sgi") return sgi_trouble(path);
  return format == "openexr" ? exr_trouble(path) : "";
}

}  // namespace kaustik::images
