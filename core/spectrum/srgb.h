#pragma once
// The transfer curve of sRGB (IEC 61966-2-1), which 8- and 16-bit pictures are stored with. Float or double;
// alpha is never encoded.

#include <cmath>

namespace kaustik {

template <class T>
T linear_from_srgb(T encoded) {
  return encoded <= T(0.04045) ? encoded / T(12.92) : std::pow((encoded + T(0.055)) / T(1.055), T(2.4));
}

template <class T>
T srgb_from_linear(T linear) {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, 1 / T(2.4)) - T(0.055);
}

}  // namespace kaustik
