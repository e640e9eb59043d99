// Has libFuzzer change pbrt scenes by directives, parameters and values, and some of them by bytes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tests/fuzz/mutator/pbrt_mutator.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

std::string_view as_text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}
size_t store(const std::string& text, uint8_t* data) {
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  if (seed % 10 == 0) return LLVMFuzzerMutate(data, size, max_size);
  return store(kaustik::fuzz::mutate_pbrt(as_text(data, size), max_size, seed), data);
}

extern "C" size_t LLVMFuzzerCustomCrossOver(const uint8_t* a, size_t a_size, const uint8_t* b, size_t b_size,
                                            uint8_t* out, size_t max_size, unsigned seed) {
  return store(kaustik::fuzz::splice_pbrt(as_text(a, a_size), as_text(b, b_size), max_size, seed), out);
}
