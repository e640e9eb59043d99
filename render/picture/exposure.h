#pragma once
// The exposure at which a picture is shown if nobody chooses one.

#include "render/film/film.h"
#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

// The exposure in stops at which `tonemap` shows the log-average luminance of a picture (Reinhard et al.
// 2002, eq. 1) as middle grey, 18 % of the screen's white. Left out are pixels that stay black beside the
// bright ones and the brightest percent, so that neither a background nor a highlight decides. 0 for a
// picture without light. The exposure is rounded to hundredths of a stop, so that two decimals are enough to
// name it.
float automatic_exposure(const Image& picture, Tonemap tonemap);

// The same, and pixels that mostly show a light itself are left out, too. `film`: the picture's own, for its
// layers of emitted radiance. A picture that shows nothing but lights is metered as a whole.
float automatic_exposure(const Image& picture, const Film& film, Tonemap tonemap);

}  // namespace kaustik::render
