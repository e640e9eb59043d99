// Single values of the sampler, for tests.

#include "core/sampling/sampler.h"

namespace kaustik {

float sobol_owen(uint32_t index, uint64_t seed, uint32_t dimension) {
  return Sampler(seed, index, dimension).next_1d();
}

}  // namespace kaustik
