#pragma once
// The index that names nothing.

#include <cstdint>

namespace kaustik {

// An index that names nothing.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

}  // namespace kaustik
