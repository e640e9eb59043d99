#pragma once
// Published tables of the CIE as numbers.

#include <span>

namespace kaustik::cie {

inline constexpr int kFirst = 360, kStep = 5;  // nm
inline constexpr int kRows = 95;               // to 830 nm
// Of the 2-degree observer of 1931; 0: x, 1: y, 2: z.
std::span<const double, kRows> matching(int function);
// Mean and two components of the daylights, S0 to S2.
std::span<const double, kRows> daylight(int component);

inline constexpr int kFluorescentFirst = 380;
inline constexpr int kFluorescentRows = 81;  // to 780 nm
// Of light 1 to 12.
std::span<const double, kFluorescentRows> fluorescent(int light);

}  // namespace kaustik::cie
