#pragma once
// Parallel loop over the pixels of a window, which must not depend on each other.

#include "core/parallel/parallel.h"

namespace kaustik::render {

// Calls fn(x, y) for all pixels, with rows in parallel.
template <class Fn>
void for_each_pixel(int width, int height, const Fn& fn) {
  parallel::for_index(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) fn(x, y);
  });
}

}  // namespace kaustik::render
