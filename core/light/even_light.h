#pragma once
#include "core/light/light_types.h"

namespace kaustik {

// Directions from which light that is the same from everywhere matters at a receiver: by the cosine. Where
// light from behind counts too, half of them by the cosine of either side and half uniformly, for what a
// glossy lobe makes of light at a grazing angle. u in [0, 1)^2.
Vector3 sample_even_light(const LightReceiver& x, const Point2& u);
// Per solid angle; wi unit.
float even_light_pdf(const LightReceiver& x, const Vector3& wi);

}  // namespace kaustik
