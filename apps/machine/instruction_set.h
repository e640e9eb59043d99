#pragma once
// The instructions that decide the bits of a render.

#include <string>

namespace kaustik::app {

// "AVX2 (avx fma avx2)": Highway's best target here, which the SIMD loops use, and the extensions by which
// Embree and the mathematical library choose their code.
std::string instruction_set();

}  // namespace kaustik::app
