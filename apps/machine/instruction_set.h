#pragma once
// Names the CPU instructions that a render uses; renders are bit-identical only for the same set.

#include <array>
#include <string>
#include <string_view>

namespace kaustik::app {

// For example "AVX2 (avx fma avx2)": the Highway target that the SIMD loops use, and the extensions by which
// Embree and the C library choose their code.
std::string instruction_set();

// Names of --isa. native: all that the machine has.
inline constexpr std::array<std::string_view, 3> kIsaNames = {"native", "avx512", "avx2"};

// Uses no more than these instructions from now on, so that machines of different kinds give the same bits.
// State of the process; call it before any work. Throws std::invalid_argument for a name that is none of
// kIsaNames, or that this machine does not have.
void pin_instruction_set(std::string_view name);

// The name of the pin; empty if there is none.
std::string pinned_instruction_set();

}  // namespace kaustik::app
