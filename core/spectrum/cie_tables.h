#pragma once
// Published tables of the CIE.

#include <span>

namespace kaustik::cie {

inline constexpr int kFirst = 360, kStep = 5;  // nm
inline constexpr int kRows = 95;               // up to 830 nm
// Colour-matching functions of the 1931 2-degree observer; 0: x, 1: y, 2: z.
std::span<const double, kRows> matching(int function);
// The components of daylight: its mean S0, and S1 and S2.
std::span<const double, kRows> daylight(int component);

inline constexpr int kFluorescentFirst = 380;
inline constexpr int kFluorescentRows = 81;  // up to 780 nm
// The fluorescent illuminants; light: 1 to 12.
std::span<const double, kFluorescentRows> fluorescent(int light);

}  // namespace kaustik::cie
