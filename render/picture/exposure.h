#pragma once
// The exposure at which a picture is shown if nobody chooses one.

#include "render/film/film.h"
#include "render/picture/exr_file.h"
#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

// The radiance of the lights that the camera sees directly, not in glass or mirrors, for each pixel.
Image lights_seen(const Film& film);
// The same from a file's layers `emitted` and `denoising_emitted`; an image without pixels if it lacks them.
Image lights_seen(const ExrChannels& file);

// The exposure in stops at which `tonemap` shows the log-average luminance of a picture (Reinhard et al.
// 2002, eq. 1) as middle grey, 18 % of the screen's white. The logarithms are those of means over blocks of 4
// x 4 pixels: those of single pixels would fall as noise grows. Left out are pixels that mostly show a light
// of `lights` (lights_seen() of the picture, or no pixels if they are not known), and blocks that stay black
// beside the bright ones and the brightest percent, so that neither a background nor a highlight decides. A
// picture that shows nothing but lights is metered as a whole. 0 for a picture without light. The exposure is
// rounded to hundredths of a stop, so that two decimals are enough to name it.
float automatic_exposure(const Image& picture, const Image& lights, Tonemap tonemap);

}  // namespace kaustik::render
