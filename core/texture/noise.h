#pragma once

namespace kaustik {

// Perlin 2002, "Improving Noise", at (x, y, 0.5): about -1 to 1, zero at whole x and y; period 256.
float noise(float x, float y);

}  // namespace kaustik
