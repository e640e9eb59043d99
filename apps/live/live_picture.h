#pragma once
// The picture of a render that is still going on, for those who show it: threads of the render write it,
// others read it at any time.

#include <climits>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "render/film/film.h"
#include "render/picture/image.h"

namespace kaustik::app {

// One number of each pixel: of the sum of all light, or of a layer.
struct LiveChannel {
  std::string name;  // "R", "G", "B", or as in EXR files, "direct.R"
  int layer = -1;    // an index into render::kLayerTable; -1: all light
  int number = 0;    // of the layer's numbers
};

// All light, and the layers of the names. Throws std::invalid_argument as layers_from_names() does.
std::vector<LiveChannel> live_channels(const std::vector<std::string>& layers);

class LivePicture {
 public:
  static constexpr int kTile = 64;  // pixels a side; changes are found tile by tile

  // range: the pixels that are rendered, of a picture of full_width x full_height pixels.
  LivePicture(const render::PixelRange& range, int full_width, int full_height);

  const render::PixelRange& range() const { return range_; }
  int full_width() const { return full_width_; }
  int full_height() const { return full_height_; }

  // For render::RenderTask::on_pixels.
  void add(const render::PixelRange& range, int cell, const render::FilmSums& sums);
  // Replaces all pixels, after a pass or at the end. shown: the picture in place of the film's sum of all
  // light, of the film's size, or null.
  void show(const render::Film& film, const render::Image* shown = nullptr);

  struct Changes {
    uint64_t version = 0;  // of the picture with these changes; it grows with each of them
    std::vector<render::PixelRange> tiles;
  };
  // The tiles that have changed since the picture had this version; version 0 is the empty picture.
  Changes changed_since(uint64_t version) const;
  // All of it as it is now: the layers, and the picture of all light.
  render::Film film() const;
  render::Image picture() const;
  // Copies the channels of the pixels of a range, row by row, those of a pixel together. Where nothing is
  // known, they are 0.
  void read(const render::PixelRange& range, const std::vector<LiveChannel>& channels, float* values) const;

 private:
  // render::kRayBlock pixels a side, which the render completes together.
  struct Block {
    render::PixelResult mean{};  // of the coarser block that stands for it
    int cell = INT_MAX;          // the side of that block's cell
    bool known = false;          // its own pixels are there
  };

  size_t pixel_index(int x, int y) const;
  size_t block_index(int x, int y) const;
  size_t tile_index(int x, int y) const;
  const render::PixelResult& value(int x, int y) const;
  Rgb all_light(int x, int y) const;
  Rgb light_of(size_t pixel, const render::PixelResult& value) const;
  // Calls fn(part) for the parts of a range in each tile while the tile is locked.
  template <class Fn>
  void for_each_tile(const render::PixelRange& range, const Fn& fn) const;
  void changed(const render::PixelRange& tile);
  // Lets the mean of a block's pixels stand for the unknown blocks of its cell.
  void stand_for_cell(const render::PixelRange& range, int cell,
                      const std::vector<render::PixelResult>& values);

  render::PixelRange range_;
  int full_width_, full_height_;
  std::vector<render::PixelResult> pixels_;
  std::vector<Rgb> shown_;  // all light, where it is not that of the layers; or empty
  std::vector<Block> blocks_;
  std::unique_ptr<std::mutex[]> tile_mutexes_;  // guard the pixels and blocks of a tile
  mutable std::mutex versions_mutex_;           // guards what follows
  std::vector<uint64_t> versions_;              // of the tiles
  uint64_t version_ = 0;
};

}  // namespace kaustik::app
