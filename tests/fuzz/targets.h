#pragma once
// Fuzz targets: each gives one parser an input as a user would, by a file where the parser reads files. An
// input that is wrong must end in what the parser documents, an error or an exception of its own type.
// Anything else is a defect: a crash, a report of a sanitizer, another exception, a Violation, an answer that
// takes seconds or gigabytes.

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>

namespace kaustik::fuzz {

using Bytes = std::span<const uint8_t>;

// Thrown when a parser breaks its contract without a crash, such as a failure without an error.
class Violation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

void fuzz_bench_json(Bytes input);
void fuzz_exr(Bytes input);
void fuzz_gltf(Bytes input);
void fuzz_http(Bytes input);
void fuzz_image(Bytes input);
void fuzz_kmap(Bytes input);
void fuzz_kpart(Bytes input);
void fuzz_obj(Bytes input);
void fuzz_pbrt(Bytes input);
void fuzz_ply(Bytes input);
void fuzz_stl(Bytes input);
void fuzz_sweep_json(Bytes input);
void fuzz_tokenizer(Bytes input);

struct Target {
  std::string_view name;  // of its folder in tests/fuzz/corpus
  void (*run)(Bytes input);
};
inline constexpr std::array kTargets = {
    Target{"bench_json", fuzz_bench_json},
    Target{"exr", fuzz_exr},
    Target{"gltf", fuzz_gltf},
    Target{"http", fuzz_http},
    Target{"image", fuzz_image},
    Target{"kmap", fuzz_kmap},
    Target{"kpart", fuzz_kpart},
    Target{"obj", fuzz_obj},
    Target{"pbrt", fuzz_pbrt},
    Target{"ply", fuzz_ply},
    Target{"stl", fuzz_stl},
    Target{"sweep_json", fuzz_sweep_json},
    Target{"tokenizer", fuzz_tokenizer},
};

}  // namespace kaustik::fuzz
