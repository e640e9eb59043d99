// The bytes of pictures, read back by decoders that know nothing of the encoders.

#include <gtest/gtest.h>

#include <cmath>

#include "apps/live/terminal/half_blocks.h"
#include "apps/live/terminal/kitty.h"
#include "apps/live/terminal/sixel.h"
#include "tests/apps/live/support/decoders.h"
#include "tests/apps/live/support/screen_model.h"

namespace kaustik::app {
namespace {

using test::ScreenModel;

Pixels8 noise(int width, int height, uint32_t seed = 1) {
  Pixels8 pixels(width, height);
  for (Pixels8::Colour& colour : pixels.colours)
    for (uint8_t& value : colour) value = uint8_t((seed = seed * 1664525 + 1013904223) >> 24);
  return pixels;
}

std::string all_lines(const Pixels8& pixels) {
  return draw_lines(half_block_lines(pixels), {});
}

TEST(HalfBlocks, GiveThePixelsBack) {
  for (const int height : {1, 2, 7, 16}) {
    const Pixels8 pixels = noise(23, height);
    ScreenModel model(40, 24);
    for (int i = 0; i < height; ++i) model.write("\n");
    model.write("\x1b[" + std::to_string(height) + "A" + all_lines(pixels));
    EXPECT_TRUE(model.unknown().empty());
    EXPECT_EQ(model.half_blocks().height, height);
    EXPECT_EQ(model.half_blocks().colours, pixels.colours);
    model.write("\r\x1b[1Bx");
    EXPECT_FALSE(model.cell(model.cursor_line(), 0).front) << "colours reach beyond the picture";
  }
}

TEST(HalfBlocks, OnlyLinesThatChangedAreSent) {
  const Pixels8 before = noise(20, 12);
  Pixels8 after = before;
  after.at(3, 4) = {1, 2, 3};
  after.at(19, 11) = {4, 5, 6};
  ScreenModel model(40, 24);
  model.write("\n\n\n\n\n\n\x1b[6A");
  model.write(all_lines(before) + "\r\x1b[5A");
  const std::string changes = draw_lines(half_block_lines(after), half_block_lines(before));
  EXPECT_LT(changes.size(), all_lines(after).size() / 2);
  model.write(changes);
  EXPECT_EQ(model.half_blocks().colours, after.colours);
  EXPECT_EQ(draw_lines(half_block_lines(after), half_block_lines(after)), "");
}

TEST(HalfBlocks, EqualColoursAreSentOnce) {
  Pixels8 grey(60, 2);
  for (Pixels8::Colour& colour : grey.colours) colour = {128, 128, 128};
  const std::string bytes = all_lines(grey);
  EXPECT_EQ(bytes.find("\x1b[38", 1), std::string::npos);
  EXPECT_EQ(bytes.find("\x1b[48"), bytes.rfind("\x1b[48"));
}

TEST(Kitty, GivesThePixelsBack) {
  for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {640, 41}}) {
    const Pixels8 pixels = noise(width, height);
    test::KittyImage image = test::decoded_kitty(kitty_picture(pixels, {77}));
    EXPECT_EQ(image.pixels.width, width);
    EXPECT_EQ(image.pixels.colours, pixels.colours);
    EXPECT_EQ(image.keys["i"], "77");
    EXPECT_EQ(image.keys["f"], "24");
    EXPECT_EQ(image.keys["C"], "1");
    EXPECT_FALSE(image.keys.contains("c"));
    // Noise does not shrink, and 4 characters carry 3 bytes.
    EXPECT_GE(image.chunks, size_t(width * height * 4 / 4096));
  }
}

TEST(Kitty, StretchesThePictureToCells) {
  test::KittyImage image = test::decoded_kitty(kitty_picture(noise(9, 9), {1, 12, 5}));
  EXPECT_EQ(image.keys["c"], "12");
  EXPECT_EQ(image.keys["r"], "5");
}

TEST(Sixel, DrawsEachPixelOnce) {
  for (const auto& [width, height] : {std::pair(1, 1), {7, 5}, {50, 6}, {333, 61}}) {
    const std::string bytes = sixel_picture(noise(width, height));
    const test::SixelDecoder image(bytes);
    EXPECT_EQ(image.pixels().width, width);
    EXPECT_EQ(image.pixels().height, height);
    EXPECT_TRUE(image.complete());
    EXPECT_LE(image.colours(), 256u);
  }
}

// A pixel is one of the two nearest levels: 1/5 or 1/6 apart, given in whole percents, read as whole 255ths.
TEST(Sixel, ColoursAreNearAndTheirMeansNearer) {
  const double kGiven = 0.005 + 0.5 / 255;
  const Pixels8 pixels = noise(160, 80, 5);
  const Pixels8 shown = test::SixelDecoder(sixel_picture(pixels)).pixels();
  for (size_t i = 0; i < pixels.colours.size(); ++i)
    for (size_t c = 0; c < 3; ++c)
      ASSERT_LE(std::abs(int(shown.colours[i][c]) - int(pixels.colours[i][c])),
                255 * ((c == 1 ? 1 / 6.0 : 1 / 5.0) + kGiven));
  for (int level = 0; level < 256; level += 5) {
    Pixels8 flat(8, 8);
    for (Pixels8::Colour& colour : flat.colours) colour.fill(uint8_t(level));
    const Pixels8 of_flat = test::SixelDecoder(sixel_picture(flat)).pixels();
    for (size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (const Pixels8::Colour& colour : of_flat.colours) sum += colour[c];
      // 64 thresholds: the share of pixels of the upper level is right to half of 1/64, of a fifth of 255.
      EXPECT_NEAR(sum / 64, level, 255 * (0.2 / 128 + kGiven)) << c;
    }
  }
}

TEST(Sixel, EqualColumnsAreOneRun) {
  Pixels8 flat(600, 6);
  for (Pixels8::Colour& colour : flat.colours) colour = {255, 0, 255};
  EXPECT_LT(sixel_picture(flat).size(), 60u);
}

}  // namespace
}  // namespace kaustik::app
