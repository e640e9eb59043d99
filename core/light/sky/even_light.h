#pragma once
// Sampling of directions for light that arrives with the same radiance from everywhere.

#include "core/light/interface/light_types.h"

namespace kaustik {

// Samples directions for uniform environment light at a receiver: by the cosine if only the front counts. If
// light from behind counts as well, a quarter of the samples goes to either side by the cosine and half are
// uniform, because a glossy lobe may reflect light at grazing angles. u in [0, 1)^2.
Vector3 sample_even_light(const LightReceiver& x, const Point2& u);
// Density of sample_even_light per solid angle; wi unit.
float even_light_pdf(const LightReceiver& x, const Vector3& wi);

}  // namespace kaustik
