#pragma once
// Smaller copies of pictures, for previews.

#include "render/picture/image.h"

namespace kaustik::render {

// Shrinks the picture so that no side is longer than `longest` pixels (at least 1), keeping the proportions:
// each pixel is the mean over the area that it covers. A picture that is small enough is returned unchanged.
// A NaN makes all pixels NaN that cover it.
Image shrunk(const Image& image, int longest);
// The same for a size that may change the proportions; neither side may be longer than the picture's.
Image shrunk_to(const Image& image, int width, int height);

}  // namespace kaustik::render
