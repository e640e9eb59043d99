#pragma once
// How large a picture is shown in a terminal.

#include "apps/console/terminal_size.h"

namespace kaustik::app {

enum class PictureWay { kKitty, kSixel, kHalfBlocks };

struct CellSize {
  int width = 10, height = 20;  // in pixels of the screen
  bool known = false;           // not merely assumed
};

// The size of a terminal's cells: from the sizes of the terminal, else as it has answered (0: it has not),
// else what is usual.
CellSize cell_size(const TerminalSize& terminal, int answered_width, int answered_height);

struct PicturePlace {
  int columns = 0, rows = 0;  // cells that it covers; none: the terminal is too small
  int width = 0, height = 0;  // pixels to which the picture is scaled down

  bool operator==(const PicturePlace&) const = default;
};

// The largest size at which a picture of width x height pixels fits in the terminal's width and two thirds of
// its height, undistorted, if it is not enlarged beyond one pixel of what the terminal can show for each of
// its own.
PicturePlace picture_place(int width, int height, PictureWay way, const TerminalSize& terminal,
                           const CellSize& cell);

}  // namespace kaustik::app
