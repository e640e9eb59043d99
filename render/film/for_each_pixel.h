#pragma once
// Work on the pixels of a window that do not depend on each other.

#include <tbb/parallel_for.h>

namespace kaustik::render {

// fn(x, y) for all pixels, rows in parallel.
template <class Fn>
void for_each_pixel(int width, int height, const Fn& fn) {
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) fn(x, y);
  });
}

}  // namespace kaustik::render
