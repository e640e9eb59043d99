#pragma once
// Checks the sizes in the header of an EXR file against the size of the file. OpenEXR 3.1 believes them: it
// allocates two gigabytes for a string of that size in a file of some bytes. The code is in a header, since
// the library that reads images for programs has none of this folder's code.
//
// A header is a list of attributes: name and type, both ended by a zero, the size of the value in four bytes
// (little-endian), and the value. An empty name ends it. A file of several parts has a header for each, and
// an empty name after the last.

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kaustik::render {

namespace detail {

// Types of attributes whose values have one size. OpenEXR reads so many bytes whatever the header says, and
// takes what follows for the next attribute.
struct ExrType {
  std::string_view name;
  uint32_t bytes;
};
inline constexpr ExrType kExrTypes[] = {{"box2f", 16},
                                        {"box2i", 16},
                                        {"chromaticities", 32},
                                        {"compression", 1},
                                        {"deepImageState", 1},
                                        {"double", 8},
                                        {"envmap", 1},
                                        {"float", 4},
                                        {"int", 4},
                                        {"keycode", 28},
                                        {"lineOrder", 1},
                                        {"m33d", 72},
                                        {"m33f", 36},
                                        {"m44d", 128},
                                        {"m44f", 64},
                                        {"rational", 8},
                                        {"tiledesc", 9},
                                        {"timecode", 8},
                                        {"v2d", 16},
                                        {"v2f", 8},
                                        {"v2i", 8},
                                        {"v3d", 24},
                                        {"v3f", 12},
                                        {"v3i", 12}};

class ExrHeaderCheck {
 public:
  explicit ExrHeaderCheck(const std::string& path) : file_(path, std::ios::binary) {
    std::error_code unknown;
    size_ = std::filesystem::file_size(path, unknown);
    if (unknown) size_ = 0;
  }

  void run() {
    if (!file_) return;
    constexpr uint32_t kSeveralParts = 0x1000;
    number();  // the mark by which the format is known
    const bool several = (number() & kSeveralParts) != 0;
    bool any = false;
    do {
      any = false;
      while (attribute()) any = true;
    } while (several && any);
  }

 private:
  // Passes an attribute. Returns false after the last.
  bool attribute() {
    name_ = text();
    if (name_.empty()) return false;
    const std::string type = text();
    const uint32_t bytes = number();
    at_most(bytes, left());
    for (const ExrType& known : kExrTypes)
      if (type == known.name && bytes != known.bytes) fail(bytes, known.bytes);
    if (type == "stringvector")
      strings(bytes);
    else if (type == "chlist")
      channels(bytes);
    else
      file_.ignore(bytes);
    return true;
  }

  // A list of strings: the size of each in four bytes, then its characters.
  void strings(uint64_t bytes) {
    constexpr uint64_t kSizeBytes = 4;
    while (bytes > 0) {
      at_most(kSizeBytes, bytes);
      const uint32_t size = number();
      at_most(size, bytes - kSizeBytes);
      file_.ignore(size);
      bytes -= kSizeBytes + size;
    }
  }

  // A list of channels: the name of each, ended by a zero, then its description. An empty name ends it.
  void channels(uint64_t bytes) {
    constexpr uint64_t kDescriptionBytes = 16;
    uint64_t used = 0;
    for (std::string channel = text(); !channel.empty(); channel = text()) {
      file_.ignore(kDescriptionBytes);
      used += channel.size() + 1 + kDescriptionBytes;
    }
    if (used + 1 != bytes) fail(bytes, used + 1);
  }

  void at_most(uint64_t bytes, uint64_t left) const {
    if (bytes > left) fail(bytes, left);
  }
  [[noreturn]] void fail(uint64_t bytes, uint64_t there) const {
    throw std::runtime_error("the file is damaged or truncated: its attribute \"" + name_ +
                             "\" should have " + std::to_string(bytes) + " bytes, and has " +
                             std::to_string(there));
  }

  // The bytes up to the next zero.
  std::string text() {
    constexpr size_t kMost = 255;
    std::string out;
    for (char c = 0; out.size() <= kMost && file_.get(c) && c != 0;) out += c;
    if (!file_ || out.size() > kMost)
      throw std::runtime_error("the file is damaged or truncated: its header has no end");
    return out;
  }

  uint32_t number() {
    static_assert(std::endian::native == std::endian::little);
    uint32_t out = 0;
    file_.read(reinterpret_cast<char*>(&out), sizeof out);
    return out;
  }

  uint64_t left() {
    const auto at = file_.tellg();
    return at < 0 || static_cast<uint64_t>(at) > size_ ? 0 : size_ - static_cast<uint64_t>(at);
  }

  std::ifstream file_;
  uint64_t size_ = 0;
  std::string name_;  // of the attribute
};

}  // namespace detail

// Throws std::runtime_error if the sizes of attributes disagree with the file's size or with their contents.
// What else may be wrong with the file or its header is left to OpenEXR to refuse.
inline void check_exr_header(const std::string& path) {
  detail::ExrHeaderCheck(path).run();
}

}  // namespace kaustik::render
