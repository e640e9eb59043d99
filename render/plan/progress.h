#pragma once
// Progress of a render.

#include <cstdint>
#include <functional>
#include <string_view>

namespace kaustik::render {

struct Progress {
  std::string_view phase;        // "photons", "build", "render"
  uint64_t done = 0, total = 0;  // of the phase in this pass
  // In each pass the phases photons, build and render follow each other; passes = 0: unknown.
  uint64_t pass = 0, passes = 1;
};
// Called from worker threads, one call at a time. Returning false cancels.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace kaustik::render
