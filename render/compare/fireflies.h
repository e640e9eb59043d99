#pragma once
// Finds single bright pixels that a reference does not have.

#include "render/compare/compare.h"

namespace kaustik::render {

// A firefly is brighter, in luminance, than ten times the median of the 5 x 5 pixels about it (cut at the
// border), which counts as a hundredth of the reference's mean at least; and it is more than twice as bright
// as in the reference. The eye sees these pixels first, though they change a mean over all pixels little.
struct Fireflies {
  uint64_t count = 0;
  int x = 0, y = 0;                 // the one of the largest luminance
  double image = 0, reference = 0;  // its luminance
};

// Counts the fireflies among the compared pixels. Throws as compare() does.
Fireflies find_fireflies(const Image& reference, const Image& image, const CompareOptions& options = {});

}  // namespace kaustik::render
