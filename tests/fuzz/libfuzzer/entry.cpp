// What libFuzzer calls; compiled once for each target, which KAUSTIK_FUZZ_TARGET names.

#include <tbb/global_control.h>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  // One thread, so that the same input takes the same path; several fuzzers run side by side.
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  kaustik::fuzz::KAUSTIK_FUZZ_TARGET({data, size});
  return 0;
}
