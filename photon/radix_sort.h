#pragma once
// Parallel radix sort of Morton keys.

#include <cstdint>

#include "photon/uninitialised_array.h"

namespace kaustik::photon {

// Sorts by key; equal keys keep their order, so the photon index is the tie-break when `values` starts as
// 0, 1, 2 ... Least significant digit first; fixed blocks with their own histograms, joined in block order:
// the result does not depend on the number of threads. Digits that are the same in all keys are skipped.
// Needs as much memory again while it runs. Both arrays have the same size.
void radix_sort(UninitialisedArray<uint64_t>& keys, UninitialisedArray<uint32_t>& values);

}  // namespace kaustik::photon
