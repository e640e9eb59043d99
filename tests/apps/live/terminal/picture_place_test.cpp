#include "apps/live/terminal/picture_place.h"

#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

constexpr PictureWay kWays[] = {PictureWay::kKitty, PictureWay::kSixel, PictureWay::kHalfBlocks};

TEST(PicturePlace, FitsTheWidthAndTwoThirdsOfTheHeight) {
  for (const PictureWay way : kWays)
    for (int columns = 0; columns < 220; columns += 7)
      for (int rows = 0; rows < 90; rows += 5)
        for (const auto& [width, height] :
             {std::pair(1920, 1080), {300, 2000}, {5000, 40}, {1, 1}, {16, 9}}) {
          const CellSize cell{9, 18, true};
          const PicturePlace place = picture_place(width, height, way, {columns, rows}, cell);
          if (columns < 4 || rows < 3) {
            EXPECT_EQ(place.rows, 0);
            continue;
          }
          ASSERT_GE(place.rows, 1);
          ASSERT_LE(3 * place.rows, 2 * rows);
          ASSERT_LE(place.columns, columns);
          ASSERT_GE(place.width, 1);
          ASSERT_LE(place.width, width);
          ASSERT_GE(place.height, 1);
          ASSERT_LE(place.height, height);
          const bool cells = way == PictureWay::kHalfBlocks;
          ASSERT_LE(place.width, cells ? place.columns : place.columns * cell.width);
          // Sixels are sent six rows at a time.
          const int sent = way == PictureWay::kSixel ? (place.height + 5) / 6 * 6 : place.height;
          ASSERT_LE(sent, cells ? 2 * place.rows : place.rows * cell.height);
        }
}

TEST(PicturePlace, KeepsTheProportions) {
  // 16 of 24 lines: 320 pixels of the screen, of which a picture 16:9 takes 569 x 320.
  const CellSize cell{10, 20, true};
  const PicturePlace kitty = picture_place(1920, 1080, PictureWay::kKitty, {80, 24}, cell);
  EXPECT_EQ(kitty, (PicturePlace{57, 16, 569, 320}));
  const PicturePlace blocks = picture_place(1920, 1080, PictureWay::kHalfBlocks, {80, 24}, cell);
  EXPECT_EQ(blocks, (PicturePlace{57, 16, 57, 32}));
  const PicturePlace sixel = picture_place(1920, 1080, PictureWay::kSixel, {80, 24}, cell);
  EXPECT_EQ(sixel, (PicturePlace{57, 16, 565, 318}));
  // Narrow cells: a half is 8 x 10 pixels.
  const PicturePlace narrow = picture_place(1000, 1000, PictureWay::kHalfBlocks, {80, 24}, {8, 20, true});
  EXPECT_EQ(narrow, (PicturePlace{40, 16, 40, 32}));
}

TEST(PicturePlace, DoesNotEnlarge) {
  EXPECT_EQ(picture_place(40, 30, PictureWay::kKitty, {200, 60}, {}), (PicturePlace{4, 2, 40, 30}));
  EXPECT_EQ(picture_place(40, 31, PictureWay::kHalfBlocks, {200, 60}, {}), (PicturePlace{40, 16, 40, 31}));
}

TEST(CellSize, IsToldOrAnsweredOrAssumed) {
  const CellSize told = cell_size({100, 50, 900, 1000}, 7, 14);
  EXPECT_TRUE(told.width == 9 && told.height == 20 && told.known);
  const CellSize answered = cell_size({100, 50}, 7, 14);
  EXPECT_TRUE(answered.width == 7 && answered.height == 14 && answered.known);
  const CellSize assumed = cell_size({100, 50}, 0, 0);
  EXPECT_TRUE(assumed.width == 10 && assumed.height == 20 && !assumed.known);
}

}  // namespace
}  // namespace kaustik::app
