#include "apps/live/tev_protocol.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

namespace kaustik::app {

using render::PixelRange;

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are sent as they lie in memory");

constexpr uint8_t kCreate = 4, kUpdate = 6;  // the third form of updates: channels with offsets and strides

class MessageBytes {
 public:
  explicit MessageBytes(uint8_t kind) { add(uint32_t{0}), add(kind); }

  template <class Number>
  void add(Number number) {
    add(&number, sizeof number);
  }
  void add(const std::string& text) { add(text.c_str(), text.size() + 1); }
  void add(const void* bytes, size_t size) { bytes_.append(static_cast<const char*>(bytes), size); }
  void add_names(const std::vector<LiveChannel>& channels) {
    for (const LiveChannel& channel : channels) add(channel.name);
  }

  std::string finish() && {
    const auto size = uint32_t(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string tev_create(const std::string& name, int width, int height,
                       const std::vector<LiveChannel>& channels) {
  MessageBytes message(kCreate);
  message.add(uint8_t{1});  // to the front
  message.add(name);
  message.add(int32_t{width}), message.add(int32_t{height}), message.add(int32_t(channels.size()));
  message.add_names(channels);
  return std::move(message).finish();
}

std::string tev_update(const std::string& name, const PixelRange& range,
                       const std::vector<LiveChannel>& channels, std::span<const float> values) {
  MessageBytes message(kUpdate);
  message.add(uint8_t{0});  // stays where it is
  message.add(name);
  message.add(int32_t(channels.size()));
  message.add_names(channels);
  message.add(int32_t{range.x0}), message.add(int32_t{range.y0});
  message.add(int32_t{range.width()}), message.add(int32_t{range.height()});
  for (size_t c = 0; c < channels.size(); ++c) message.add(int64_t(c));                // offsets
  for (size_t c = 0; c < channels.size(); ++c) message.add(int64_t(channels.size()));  // strides
  message.add(values.data(), values.size_bytes());
  return std::move(message).finish();
}

std::vector<PixelRange> joined_tiles(const std::vector<PixelRange>& tiles, size_t channels) {
  constexpr size_t kMostBytes = 4 << 20;
  int side = 256;
  while (side > LivePicture::kTile && size_t(side) * size_t(side) * channels * sizeof(float) > kMostBytes)
    side /= 2;
  std::map<std::pair<int, int>, PixelRange> squares;
  for (const PixelRange& tile : tiles) {
    const auto [at, is_new] = squares.try_emplace({tile.y0 / side, tile.x0 / side}, tile);
    PixelRange& joined = at->second;
    joined.x0 = std::min(joined.x0, tile.x0), joined.x1 = std::max(joined.x1, tile.x1);
    joined.y0 = std::min(joined.y0, tile.y0), joined.y1 = std::max(joined.y1, tile.y1);
  }
  std::vector<PixelRange> ranges;
  for (const auto& [square, range] : squares) ranges.push_back(range);
  return ranges;
}

}  // namespace kaustik::app
