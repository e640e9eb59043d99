// The parts of the tracer that are not templates.

#include "photon/trace/tracer.h"

namespace kaustik::photon {

TraceCounters& TraceCounters::operator+=(const TraceCounters& o) {
  emitted += o.emitted;
  rays += o.rays;
  shadow_rays += o.shadow_rays;
  for (size_t k = 0; k < stored.size(); ++k) stored[k] += o.stored[k];
  dropped_invalid += o.dropped_invalid;
  energy += o.energy;
  return *this;
}

uint64_t photon_stream(const TraceSettings& settings) {
  constexpr uint64_t kPhotonTag = 0x70686f746f6eull;  // "photon" in ASCII
  return hash_combine(hash_combine(settings.seed, settings.pass), kPhotonTag);
}

}  // namespace kaustik::photon
