#include "apps/live/terminal/kitty.h"

#include <fmt/format.h>
#include <zlib.h>

#include <stdexcept>
#include <string_view>

namespace kaustik::app {

namespace {

constexpr size_t kChunk = 4096;  // the most bytes of base64 that one command may carry

std::string deflated(const Pixels8& pixels) {
  const uLong size = uLong(pixels.colours.size() * sizeof(Pixels8::Colour));
  uLong taken = compressBound(size);
  std::string bytes(taken, '\0');
  // The fastest level: a render's noise hardly shrinks with more effort.
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &taken,
                reinterpret_cast<const Bytef*>(pixels.colours.data()), size, Z_BEST_SPEED) != Z_OK)
    throw std::runtime_error("zlib cannot compress the preview");
  bytes.resize(taken);
  return bytes;
}

// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t j = 0; j < 3; ++j) group = group << 8 | (i + j < bytes.size() ? uint8_t(bytes[i + j]) : 0u);
    for (size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63u] : '=';
  }
  return text;
}

}  // namespace

std::string kitty_picture(const Pixels8& pixels, const KittyPlace& place) {
  const std::string payload = base64(deflated(pixels));
  std::string keys =
      fmt::format("a=T,f=24,o=z,s={},v={},i={},p=1,C=1,q=2", pixels.width, pixels.height, place.id);
  if (place.columns > 0) keys += fmt::format(",c={},r={}", place.columns, place.rows);
  std::string bytes;
  for (size_t i = 0; i < payload.size(); i += kChunk) {
    const bool more = i + kChunk < payload.size();
    bytes +=
        fmt::format("\x1b_G{},m={};{}\x1b\\", i == 0 ? keys : "q=2", int(more), payload.substr(i, kChunk));
  }
  return bytes;
}

std::string kitty_removal(uint32_t id) {
  return fmt::format("\x1b_Ga=d,d=I,i={},q=2\x1b\\", id);
}

}  // namespace kaustik::app
