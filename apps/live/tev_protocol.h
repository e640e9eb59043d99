#pragma once
// Messages of the protocol by which renderers show pictures in tev (https://github.com/Tom94/tev, Ipc.h) and
// HDRView. Each is its size in bytes, itself included (u32), a number that says what it is (u8), and its
// contents; numbers are little-endian, texts end with a zero.
//
// Not used: opening and reloading files, closing pictures, vector graphics.

#include <span>
#include <string>
#include <vector>

#include "apps/live/live_picture.h"

namespace kaustik::app {

// Makes a picture without contents, and brings it to the front. It takes the place of one of the same name.
std::string tev_create(const std::string& name, int width, int height,
                       const std::vector<LiveChannel>& channels);

// Sets a rectangle of a picture. values: row by row, the channels of a pixel together.
std::string tev_update(const std::string& name, const render::PixelRange& range,
                       const std::vector<LiveChannel>& channels, std::span<const float> values);

// Few messages are better than many: joins tiles that have changed to rectangles that hold them, in a grid of
// squares that is as coarse as it can be while an update of all channels keeps to a few megabytes: 64, 128 or
// 256 pixels a side.
std::vector<render::PixelRange> joined_tiles(const std::vector<render::PixelRange>& tiles, size_t channels);

}  // namespace kaustik::app
