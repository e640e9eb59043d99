#include "render/picture/legend.h"

#include <algorithm>
#include <array>

#include "core/spectrum/srgb.h"

namespace kaustik::render {

namespace {

// A letter of 5 x 7 pixels: rows from the top, whose lowest bit is the right pixel.
using Glyph = std::array<uint8_t, 7>;
constexpr int kGlyphWidth = 5, kGlyphHeight = 7;
constexpr std::array<Glyph, 26> kLetters = {
    Glyph{0x00, 0x00, 0x0e, 0x01, 0x0f, 0x11, 0x0f}, Glyph{0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x1e},  // a b
    Glyph{0x00, 0x00, 0x0e, 0x10, 0x10, 0x11, 0x0e}, Glyph{0x01, 0x01, 0x0d, 0x13, 0x11, 0x11, 0x0f},  // c d
    Glyph{0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}, Glyph{0x06, 0x09, 0x08, 0x1c, 0x08, 0x08, 0x08},  // e f
    Glyph{0x00, 0x0f, 0x11, 0x11, 0x0f, 0x01, 0x0e}, Glyph{0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x11},  // g h
    Glyph{0x04, 0x00, 0x0c, 0x04, 0x04, 0x04, 0x0e}, Glyph{0x02, 0x00, 0x06, 0x02, 0x02, 0x12, 0x0c},  // i j
    Glyph{0x10, 0x10, 0x12, 0x14, 0x18, 0x14, 0x12}, Glyph{0x0c, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e},  // k l
    Glyph{0x00, 0x00, 0x1a, 0x15, 0x15, 0x11, 0x11}, Glyph{0x00, 0x00, 0x16, 0x19, 0x11, 0x11, 0x11},  // m n
    Glyph{0x00, 0x00, 0x0e, 0x11, 0x11, 0x11, 0x0e}, Glyph{0x00, 0x00, 0x1e, 0x11, 0x1e, 0x10, 0x10},  // o p
    Glyph{0x00, 0x00, 0x0d, 0x13, 0x0f, 0x01, 0x01}, Glyph{0x00, 0x00, 0x16, 0x19, 0x10, 0x10, 0x10},  // q r
    Glyph{0x00, 0x00, 0x0e, 0x10, 0x0e, 0x01, 0x1e}, Glyph{0x08, 0x08, 0x1c, 0x08, 0x08, 0x09, 0x06},  // s t
    Glyph{0x00, 0x00, 0x11, 0x11, 0x11, 0x13, 0x0d}, Glyph{0x00, 0x00, 0x11, 0x11, 0x11, 0x0a, 0x04},  // u v
    Glyph{0x00, 0x00, 0x11, 0x11, 0x15, 0x15, 0x0a}, Glyph{0x00, 0x00, 0x11, 0x0a, 0x04, 0x0a, 0x11},  // w x
    Glyph{0x00, 0x00, 0x11, 0x11, 0x0f, 0x01, 0x0e}, Glyph{0x00, 0x00, 0x1f, 0x02, 0x04, 0x08, 0x1f},  // y z
};

// In units of a letter's pixel: between letters, between lines and around the legend, and the colour's field.
constexpr int kGap = 1, kLineGap = 3, kMargin = 4, kField = kGlyphHeight;
constexpr int kHeightOfUnit = 400;  // pixels of the picture's height for which a unit grows by a pixel
constexpr float kGround = 0.2f;     // what remains of the picture below the legend
constexpr Rgb kInk{0.8f};

struct Layout {
  int unit = 1, width = 0, height = 0;  // pixels
};

int width_of(const LegendEntry& entry) {
  return kField + kLineGap + int(entry.text.size()) * (kGlyphWidth + kGap);
}

Layout layout_of(const Image& image, std::span<const LegendEntry> entries) {
  int widest = 0;
  for (const LegendEntry& entry : entries) widest = std::max(widest, width_of(entry));
  const int units_high = int(entries.size()) * (kGlyphHeight + kLineGap) - kLineGap + 2 * kMargin;
  const int units_wide = widest + 2 * kMargin;
  const int wanted = 1 + image.height / kHeightOfUnit;
  const int unit = std::min({wanted, image.width / units_wide, image.height / (2 * units_high)});
  return {unit, unit * units_wide, unit * units_high};
}

void fill(Image& image, int x0, int y0, int width, int height, const Rgb& colour) {
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x) image.at(x, y) = colour;
}

void draw_letter(Image& image, int x0, int y0, int unit, char letter) {
  if (letter < 'a' || letter > 'z') return;
  const Glyph& glyph = kLetters[size_t(letter - 'a')];
  for (int y = 0; y < kGlyphHeight; ++y)
    for (int x = 0; x < kGlyphWidth; ++x)
      if ((glyph[size_t(y)] >> (kGlyphWidth - 1 - x)) & 1)
        fill(image, x0 + unit * x, y0 + unit * y, unit, unit, kInk);
}

}  // namespace

bool draw_legend(Image& image, std::span<const LegendEntry> entries) {
  if (entries.empty()) return false;
  const auto [unit, width, height] = layout_of(image, entries);
  if (unit < 1) return false;
  const int top = image.height - height;
  for (int y = top; y < image.height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) *= kGround;
  int y = top + unit * kMargin;
  for (const LegendEntry& entry : entries) {
    Rgb colour;
    for (int c = 0; c < 3; ++c) colour[c] = linear_from_srgb(float(entry.colour[c]) / 255);
    fill(image, unit * kMargin, y, unit * kField, unit * kField, colour);
    int x = unit * (kMargin + kField + kLineGap);
    for (const char letter : entry.text) {
      draw_letter(image, x, y, unit, letter);
      x += unit * (kGlyphWidth + kGap);
    }
    y += unit * (kGlyphHeight + kLineGap);
  }
  return true;
}

}  // namespace kaustik::render
