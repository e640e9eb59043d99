#include "apps/live/live_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/picture/image_io.h"

namespace kaustik::app {

using render::PixelRange;
using render::PixelResult;

namespace {

// Blocks and tiles are counted from the corner of the full picture.
int count_across(int begin, int end, int side) {
  return (end - 1) / side - begin / side + 1;
}

size_t index_in_grid(const PixelRange& range, int x, int y, int side) {
  const int across = count_across(range.x0, range.x1, side);
  return size_t(y / side - range.y0 / side) * size_t(across) + size_t(x / side - range.x0 / side);
}

size_t size_of_grid(const PixelRange& range, int side) {
  return size_t(count_across(range.x0, range.x1, side)) * size_t(count_across(range.y0, range.y1, side));
}

// The mean of the samples, as shown until the exact mean of a pass takes its place.
PixelResult mean_of(const render::PixelSum& sum) {
  PixelResult mean;
  const render::PixelSum all = sum.completed();
  const int64_t weight = all.weight() > 0 ? all.weight() : int64_t(all.count);
  if (weight == 0) return mean;
  for (const render::LayerRow& row : render::kLayerTable) {
    if (!row.summed()) continue;
    const double share = row.mean == render::LayerMean::kPasses ? 1 : 1 / double(weight);
    for (size_t c = 0; c < row.channels.size(); ++c) row.in(mean)[c] = float(share * row.in(all)[c]);
  }
  return mean;
}

bool is_of_all_light(const LiveChannel& channel) {
  return channel.layer < 0;
}

void add(const PixelResult& value, float share, PixelResult* sum) {
  for (const render::LayerRow& row : render::kLayerTable)
    for (size_t c = 0; c < row.channels.size(); ++c) row.in(*sum)[c] += share * row.in(value)[c];
}

}  // namespace

std::vector<LiveChannel> live_channels(const std::vector<std::string>& layers) {
  std::vector<LiveChannel> channels;
  for (int c = 0; c < 3; ++c) channels.push_back({std::string(1, "RGB"[c]), -1, c});
  for (const render::Layer layer : render::layers_from_names(layers)) {
    const render::LayerRow& row = render::kLayerTable[size_t(layer)];
    for (size_t c = 0; c < row.channels.size(); ++c)
      channels.push_back({fmt::format("{}.{}", row.name, row.channels[c]), int(layer), int(c)});
  }
  return channels;
}

LivePicture::LivePicture(const PixelRange& range, int full_width, int full_height)
    : range_(range),
      full_width_(full_width),
      full_height_(full_height),
      pixels_(range.pixels()),
      blocks_(size_of_grid(range, render::kRayBlock)),
      tile_mutexes_(std::make_unique<std::mutex[]>(size_of_grid(range, kTile))),
      versions_(size_of_grid(range, kTile)) {}

size_t LivePicture::pixel_index(int x, int y) const {
  return size_t(y - range_.y0) * size_t(range_.width()) + size_t(x - range_.x0);
}

size_t LivePicture::block_index(int x, int y) const {
  return index_in_grid(range_, x, y, render::kRayBlock);
}

size_t LivePicture::tile_index(int x, int y) const {
  return index_in_grid(range_, x, y, kTile);
}

const PixelResult& LivePicture::value(int x, int y) const {
  const Block& block = blocks_[block_index(x, y)];
  return block.known ? pixels_[pixel_index(x, y)] : block.mean;
}

Rgb LivePicture::all_light(int x, int y) const {
  return light_of(pixel_index(x, y), value(x, y));
}

Rgb LivePicture::light_of(size_t pixel, const PixelResult& value) const {
  return shown_.empty() ? value.radiance() : shown_[pixel];
}

template <class Fn>
void LivePicture::for_each_tile(const PixelRange& range, const Fn& fn) const {
  range.for_each_square(kTile, [&](const PixelRange& part) {
    const std::lock_guard lock(tile_mutexes_[tile_index(part.x0, part.y0)]);
    fn(part);
  });
}

void LivePicture::changed(const PixelRange& tile) {
  const std::lock_guard lock(versions_mutex_);
  versions_[tile_index(tile.x0, tile.y0)] = ++version_;
}

void LivePicture::add(const PixelRange& range, int cell, const render::FilmSums& sums) {
  std::vector<PixelResult> values;
  values.reserve(range.pixels());
  for (int y = range.y0; y < range.y1; ++y)
    for (int x = range.x0; x < range.x1; ++x)
      values.push_back(mean_of(sums.at(x - sums.x0(), y - sums.y0())));
  if (cell > render::kRayBlock) stand_for_cell(range, cell, values);
  // A block lies in one tile.
  for_each_tile(range, [&](const PixelRange& part) {
    size_t i = 0;
    for (int y = range.y0; y < range.y1; ++y)
      for (int x = range.x0; x < range.x1; ++x) pixels_[pixel_index(x, y)] = values[i++];
    blocks_[block_index(range.x0, range.y0)].known = true;
    changed(part);
  });
}

void LivePicture::stand_for_cell(const PixelRange& range, int cell, const std::vector<PixelResult>& values) {
  PixelResult mean;
  for (const PixelResult& value : values) app::add(value, 1 / float(values.size()), &mean);
  const int x0 = range.x0 - range.x0 % render::kRayBlock, y0 = range.y0 - range.y0 % render::kRayBlock;
  for_each_tile(range_.in_square(x0, y0, cell), [&](const PixelRange& part) {
    part.for_each_square(render::kRayBlock, [&](const PixelRange& block) {
      Block& of = blocks_[block_index(block.x0, block.y0)];
      if (of.known || of.cell < cell) return;  // the thread was late
      of.mean = mean;
      of.cell = cell;
    });
    changed(part);
  });
}

void LivePicture::show(const render::Film& film, const render::Image* shown) {
  if (shown && shown_.empty()) {
    std::vector<Rgb> all(range_.pixels());
    // Readers look at it under the lock of any tile.
    std::vector<std::unique_lock<std::mutex>> locks;
    for (size_t i = 0; i < versions_.size(); ++i) locks.emplace_back(tile_mutexes_[i]);
    shown_ = std::move(all);
  }
  for_each_tile(range_, [&](const PixelRange& part) {
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) {
        pixels_[pixel_index(x, y)] = film.at(x - range_.x0, y - range_.y0);
        blocks_[block_index(x, y)].known = true;
        if (!shown_.empty())
          shown_[pixel_index(x, y)] =
              shown ? shown->at(x - range_.x0, y - range_.y0) : pixels_[pixel_index(x, y)].radiance();
      }
    changed(part);
  });
}

LivePicture::Changes LivePicture::changed_since(uint64_t version) const {
  Changes changes;
  const std::lock_guard lock(versions_mutex_);
  changes.version = version_;
  range_.for_each_square(kTile, [&](const PixelRange& tile) {
    if (versions_[tile_index(tile.x0, tile.y0)] > version) changes.tiles.push_back(tile);
  });
  return changes;
}

render::Film LivePicture::film() const {
  render::Film film(range_.width(), range_.height(), range_.x0, range_.y0, full_width_, full_height_);
  for_each_tile(range_, [&](const PixelRange& part) {
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) film.at(x - range_.x0, y - range_.y0) = value(x, y);
  });
  return film;
}

render::Image LivePicture::picture() const {
  render::Image image(range_.width(), range_.height());
  for_each_tile(range_, [&](const PixelRange& part) {
    for (int y = part.y0; y < part.y1; ++y)
      for (int x = part.x0; x < part.x1; ++x) image.at(x - range_.x0, y - range_.y0) = all_light(x, y);
  });
  return image;
}

void LivePicture::read(const PixelRange& range, const std::vector<LiveChannel>& channels,
                       float* values) const {
  const bool wants_light = std::any_of(channels.begin(), channels.end(), is_of_all_light);
  const auto read_pixel = [&](const PixelResult& from, const Rgb& all, float* to) {
    for (const LiveChannel& c : channels)
      *to++ = is_of_all_light(c) ? all[c.number] : render::kLayerTable[size_t(c.layer)].in(from)[c.number];
  };
  for_each_tile(range, [&](const PixelRange& part) {
    part.for_each_square(render::kRayBlock, [&](const PixelRange& square) {
      const Block& block = blocks_[block_index(square.x0, square.y0)];
      for (int y = square.y0; y < square.y1; ++y)
        for (int x = square.x0; x < square.x1; ++x) {
          const size_t i = pixel_index(x, y);
          const PixelResult& from = block.known ? pixels_[i] : block.mean;
          read_pixel(from, wants_light ? light_of(i, from) : Rgb(0),
                     values + (size_t(y - range.y0) * size_t(range.width()) + size_t(x - range.x0)) *
                                  channels.size());
        }
    });
  });
}

}  // namespace kaustik::app
