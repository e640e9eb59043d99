#pragma once
// Smaller copies of pictures, for looking at.

#include "render/picture/image.h"

namespace kaustik::render {

// No side longer than `longest` pixels (1 or more), the proportions kept: each pixel is the mean over the
// area that it covers. A picture that is small enough is returned as it is. NaN spreads to the pixels that
// cover it.
Image shrunk(const Image& image, int longest);

}  // namespace kaustik::render
