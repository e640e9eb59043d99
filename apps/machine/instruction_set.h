#pragma once
// Names the CPU instructions that a render uses; renders are bit-identical only for the same set.

#include <string>

namespace kaustik::app {

// For example "AVX2 (avx fma avx2)": the Highway target that the SIMD loops use on this machine, and the
// extensions by which Embree and the C library choose their code.
std::string instruction_set();

}  // namespace kaustik::app
