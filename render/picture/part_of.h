#pragma once
// Where a cropped picture lies in the full one.

namespace kaustik::render {

// The place of an EXR file's data window in its display window.
struct PartOf {
  int x = 0, y = 0;  // upper left pixel of the part, counted from that of the full picture
  int full_width = 0, full_height = 0;
};

}  // namespace kaustik::render
