#include "apps/live/terminal/kitty.h"

#include <fmt/format.h>
#include <zlib.h>

#include <stdexcept>
#include <string_view>

#include "core/base64.h"

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
