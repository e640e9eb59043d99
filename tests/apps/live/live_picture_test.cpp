// The picture of a render in progress: what is read while blocks arrive, and which tiles have changed.

#include "apps/live/live_picture.h"

#include <gmock/gmock.h>

#include <thread>

namespace kaustik::app {
namespace {

using render::FilmSums;
using render::PixelRange;
using ::testing::ElementsAre;

class LivePictureTest : public ::testing::Test {
 protected:
  // A block of one sample a pixel, whose direct light is `value`.
  void add(LivePicture* picture, int x, int y, int cell, float value) {
    const PixelRange block = picture->range().in_square(x, y, render::kRayBlock);
    for (int v = block.y0; v < block.y1; ++v)
      for (int u = block.x0; u < block.x1; ++u) {
        render::PixelResult sample;
        sample.direct = Rgb(value, 2 * value, 0);
        sample.depth = 7;
        sums_.at(u, v).add(sample);
      }
    picture->add(block, cell, sums_);
  }
  static std::vector<float> read(const LivePicture& picture, int x, int y,
                                 const std::vector<std::string>& layers = {}) {
    const std::vector<LiveChannel> channels = live_channels(layers);
    std::vector<float> values(channels.size());
    picture.read({x, x + 1, y, y + 1}, channels, values.data());
    return values;
  }

  FilmSums sums_{200, 100};
};

TEST_F(LivePictureTest, ACoarseBlockStandsForItsCell) {
  LivePicture picture({0, 200, 0, 100}, 200, 100);
  EXPECT_THAT(read(picture, 0, 0), ElementsAre(0, 0, 0));
  add(&picture, 64, 0, 64, 3);
  EXPECT_THAT(read(picture, 64, 0), ElementsAre(3, 6, 0));
  EXPECT_THAT(read(picture, 127, 63, {"depth"}), ElementsAre(3, 6, 0, 7));
  EXPECT_THAT(read(picture, 63, 0), ElementsAre(0, 0, 0));
  EXPECT_THAT(read(picture, 64, 64), ElementsAre(0, 0, 0));
  // A finer block takes the place of the coarse one in its own cell only.
  add(&picture, 96, 32, 32, 5);
  EXPECT_THAT(read(picture, 127, 63), ElementsAre(5, 10, 0));
  EXPECT_THAT(read(picture, 95, 32), ElementsAre(3, 6, 0));
}

TEST_F(LivePictureTest, CoarseBlocksLeaveFinerOnes) {
  LivePicture picture({0, 200, 0, 100}, 200, 100);
  add(&picture, 4, 4, 4, 1);
  add(&picture, 32, 32, 32, 3);
  add(&picture, 0, 0, 128, 2);  // a thread that was late
  EXPECT_THAT(read(picture, 5, 5), ElementsAre(1, 2, 0));
  EXPECT_THAT(read(picture, 8, 8), ElementsAre(2, 4, 0));
  EXPECT_THAT(read(picture, 63, 63), ElementsAre(3, 6, 0));
}

TEST_F(LivePictureTest, TellsWhichTilesHaveChanged) {
  LivePicture picture({0, 200, 0, 100}, 200, 100);
  EXPECT_TRUE(picture.changed_since(0).tiles.empty());
  add(&picture, 68, 4, 4, 1);
  const LivePicture::Changes first = picture.changed_since(0);
  ASSERT_EQ(first.tiles.size(), 1u);
  EXPECT_EQ(first.tiles[0].x0, 64);
  EXPECT_EQ(first.tiles[0].x1, 128);
  EXPECT_TRUE(picture.changed_since(first.version).tiles.empty());
  add(&picture, 128, 0, 128, 1);  // its cell has four tiles, of which the picture's edges leave four parts
  const LivePicture::Changes second = picture.changed_since(first.version);
  EXPECT_EQ(second.tiles.size(), 4u);
  EXPECT_EQ(second.tiles.back().x1, 200);
  EXPECT_EQ(second.tiles.back().y1, 100);
  picture.show(render::Film(200, 100));
  EXPECT_EQ(picture.changed_since(second.version).tiles.size(), 8u);
  EXPECT_THAT(read(picture, 68, 4), ElementsAre(0, 0, 0));
}

// A crop whose corner lies within a block and a tile. Cells begin at its first block.
TEST_F(LivePictureTest, CropsKeepTheCoordinatesOfThePicture) {
  LivePicture picture({70, 150, 33, 90}, 200, 100);
  add(&picture, 68, 32, 64, 1);
  EXPECT_EQ(picture.changed_since(0).tiles.size(), 4u);
  EXPECT_THAT(read(picture, 70, 33), ElementsAre(1, 2, 0));
  EXPECT_THAT(read(picture, 131, 89), ElementsAre(1, 2, 0));
  EXPECT_THAT(read(picture, 132, 63), ElementsAre(0, 0, 0));
}

// Whoever reads changes by their versions misses none of those that threads make meanwhile.
TEST_F(LivePictureTest, NoChangeIsMissed) {
  LivePicture picture({0, 200, 0, 100}, 200, 100);
  std::vector<std::thread> writers;
  for (int t = 0; t < 2; ++t)
    writers.emplace_back([&, t] {
      render::FilmSums sums(200, 100);
      for (int y = 48 * t; y < 48 * t + 48; y += 4)
        for (int x = 0; x < 200; x += 4) {
          for (int i = 0; i < 16; ++i) {
            render::PixelResult one;
            one.direct = Rgb(1, 2, 0);
            sums.at(x + i % 4, y + i / 4).add(one);
          }
          picture.add({x, x + 4, y, y + 4}, 4, sums);
        }
    });
  std::vector<float> copy(200 * 100 * 3);
  const std::vector<LiveChannel> channels = live_channels({});
  uint64_t seen = 0;
  const auto follow = [&] {
    const LivePicture::Changes changes = picture.changed_since(seen);
    seen = changes.version;
    for (const PixelRange& tile : changes.tiles) {
      std::vector<float> values(tile.pixels() * 3);
      picture.read(tile, channels, values.data());
      size_t i = 0;
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = 3 * tile.x0; x < 3 * tile.x1; ++x) copy[size_t(y * 600 + x)] = values[i++];
    }
  };
  for (int i = 0; i < 200; ++i) follow();
  for (std::thread& writer : writers) writer.join();
  follow();
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 200; ++x) ASSERT_EQ(copy[size_t(y * 600 + 3 * x + 1)], 2) << x << ' ' << y;
}

}  // namespace
}  // namespace kaustik::app
