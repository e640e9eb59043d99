#include "apps/live/terminal/picture_place.h"

#include <algorithm>
#include <cmath>

#include "apps/live/terminal/sixel.h"

namespace kaustik::app {

namespace {

// Pixels of a picture that is sent pixel by pixel: more would be slow over a network.
constexpr int kMostWidth = 1024, kMostHeight = 768;
constexpr int kLeastColumns = 4, kLeastRows = 3;  // of a terminal

int rounded(double size, int least, int most) {
  return std::clamp(int(std::lround(size)), least, std::max(least, most));
}

int divided_up(int a, int b) {
  return (a + b - 1) / b;
}

}  // namespace

CellSize cell_size(const TerminalSize& terminal, int answered_width, int answered_height) {
  const int width = terminal.width / terminal.columns, height = terminal.height / terminal.rows;
  if (width > 0 && height > 0) return {width, height, true};
  if (answered_width > 0 && answered_height > 0) return {answered_width, answered_height, true};
  return {};
}

PicturePlace picture_place(int width, int height, PictureWay way, const TerminalSize& terminal,
                           const CellSize& cell) {
  if (terminal.columns < kLeastColumns || terminal.rows < kLeastRows) return {};
  const bool cells = way == PictureWay::kHalfBlocks;
  // What shows one pixel, in pixels of the screen.
  const double dot_width = cells ? cell.width : 1, dot_height = cells ? cell.height / 2.0 : 1;
  int most_width = terminal.columns, most_height = 2 * terminal.rows / 3 * 2;
  if (!cells) {
    most_width = std::min(terminal.columns * cell.width, kMostWidth);
    most_height = std::min(2 * terminal.rows / 3 * cell.height, kMostHeight);
  }
  if (way == PictureWay::kSixel) most_height = most_height / kSixelRows * kSixelRows;
  const double scale =
      std::min({most_width * dot_width / width, most_height * dot_height / height, dot_width, dot_height});
  PicturePlace place;
  place.width = rounded(width * scale / dot_width, 1, std::min(most_width, width));
  place.height = rounded(height * scale / dot_height, 1, std::min(most_height, height));
  place.columns = cells ? place.width : divided_up(place.width, cell.width);
  const int sent =
      way == PictureWay::kSixel ? divided_up(place.height, kSixelRows) * kSixelRows : place.height;
  place.rows = cells ? divided_up(place.height, 2) : divided_up(sent, cell.height);
  return place;
}

}  // namespace kaustik::app
