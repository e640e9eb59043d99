#pragma once
// Accuracy of the flux in a photon record.

namespace kaustik::test {

// Largest error of a channel of a packed flux (RGB9E5), relative to the largest channel. The three channels
// share an exponent, and the mantissa of the largest channel is at least 256 of 511 steps after rounding to
// nearest, so the largest channel is at least 255.5 steps. Half a step is therefore at most 0.5 / 255.5 =
// 1/511 of it.
inline constexpr double kPackedFluxError = 1.0 / 511;

}  // namespace kaustik::test
