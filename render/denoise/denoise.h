#pragma once
// Filters what is left of noise out of a picture.
//
// Each class of light is filtered by itself, divided by the albedo of what is seen where surfaces scatter it
// diffusely, and guided by albedo, normal and depth (regression.h). The error is estimated from two halves of
// the samples: the filtered half A is compared with half B, whose noise is independent, and vice versa. Each
// pixel takes what has the least error about it: the filter's value, or its own samples. Where samples agree,
// such as at the edges of a caustic whose photons all samples share, nothing is changed. What the first hit
// emits is not filtered.

#include <array>

#include "render/film/halves.h"
#include "render/picture/image.h"

namespace kaustik::render {

// The classes of light that are filtered.
inline constexpr std::array kFilteredLight = {Layer::kDenoisingEmitted, Layer::kDirect, Layer::kCaustic,
                                              Layer::kIndirect};

// Whether any pixel has two halves.
bool any_halves(const HalfFilm& halves);

// The filtered radiance, of the film's size. halves: of the film's samples; their windows are equal. Pixels
// without two halves are left as they are. No channel is negative where the film's is not. The result has the
// same bits on any number of threads. Takes some 180 bytes of memory for each pixel, and 16 for each class of
// light.
Image denoise(const Film& film, const HalfFilm& halves);

}  // namespace kaustik::render
