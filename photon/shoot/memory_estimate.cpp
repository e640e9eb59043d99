// Peak memory of a shoot and of the maps built from it, as extrapolated from a small shoot.

#include "photon/shoot/memory_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/memory/memory_room.h"
#include "core/parallel/parallel.h"
#include "photon/trace/tracer.h"

namespace kaustik::photon {

namespace {

// A map uses 32-bit indices.
constexpr double kMostInMap = std::numeric_limits<uint32_t>::max() - 1.0;

// Upper bound of the photons that one emitted photon stores. Shadow photons: one for each surface along its
// ray; 64 is more than any real scene has.
double most_stored(const TraceSettings& settings) {
  const int each = 1 + (settings.kinds.medium_caustic || settings.kinds.medium_indirect ? 1 : 0);
  return each * (settings.kinds.indirect || settings.kinds.medium_indirect ? settings.max_bounces : 1) +
         (settings.kinds.shadow ? 64 : 0) + (settings.kinds.medium_caustic ? kSegmentPhotons : 0);
}

// Segments in media that a guided caustic photon has: there are a few behind a lens.
constexpr double kSegmentsOfCaustic = 4;

// All photons that guided emission may leave.
double most_guided(const TraceSettings& settings, const GuidedPhotons& guided) {
  return static_cast<double>(guided.caustic) * (settings.kinds.medium_caustic ? 1 + kSegmentsOfCaustic : 1);
}

// What a small shoot leaves.
struct FewPhotons {
  TraceCounters counters;
  uint64_t leave_indirect = 0;  // photons that leave any indirect ones
};

FewPhotons shoot_few(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings) {
  TraceSettings few = settings;
  few.photons = std::min(settings.photons, kEstimatePhotons);
  const SurfaceTable surfaces(scene);
  std::vector<FewPhotons> of_block((few.photons + kLearnBlock - 1) / kLearnBlock);
  parallel::for_index(size_t{0}, of_block.size(), [&](size_t block) {
    const uint64_t first = block * kLearnBlock, end = std::min(few.photons, first + kLearnBlock);
    std::array<bool, kLearnBlock> leaves{};
    const auto sink = [&](PhotonKind kind, const Photon&, uint64_t index) {
      leaves[index - first] |= kind == PhotonKind::kIndirect;
    };
    trace_photons(scene, surfaces, bvh, few, first, end, sink, of_block[block].counters);
    of_block[block].leave_indirect = uint64_t(std::ranges::count(leaves, true));
  });
  FewPhotons all;
  for (const FewPhotons& block : of_block)
    all.counters += block.counters, all.leave_indirect += block.leave_indirect;
  return all;
}

std::array<double, kPhotonKinds> scaled_to(uint64_t photons, const FewPhotons& few) {
  std::array<double, kPhotonKinds> stored{};
  for (size_t k = 0; k < kPhotonKinds; ++k)
    stored[k] = static_cast<double>(few.counters.stored[k]) * static_cast<double>(photons) /
                static_cast<double>(std::max<uint64_t>(1, few.counters.emitted));
  return stored;
}

// Includes the photons of guided emission: about one caustic photon each, apart from the few that a coat
// reflects, and as many indirect ones as if each photon came to where it leaves some.
std::array<double, kPhotonKinds> estimate_all(const Scene& scene, const accel::Bvh& bvh,
                                              const TraceSettings& settings, const GuidedPhotons& guided) {
  const FewPhotons few = shoot_few(scene, bvh, settings);
  auto stored = scaled_to(settings.photons, few);
  double& caustic = stored[static_cast<size_t>(PhotonKind::kCaustic)];
  caustic = std::max(caustic, static_cast<double>(guided.caustic));
  if (guided.indirect && settings.kinds.indirect) {
    double& indirect = stored[static_cast<size_t>(PhotonKind::kIndirect)];
    const double share = static_cast<double>(few.leave_indirect) / static_cast<double>(few.counters.emitted);
    indirect = share > 0 ? indirect / share : static_cast<double>(settings.photons);
  }
  if (settings.kinds.medium_caustic) {
    double& in_media = stored[static_cast<size_t>(PhotonKind::kMediumCaustic)];
    in_media = std::max(in_media, kSegmentsOfCaustic * static_cast<double>(guided.caustic));
    // The limits of photons_on_segments(): its result, from other photons than these, may be one more or
    // less.
    const double segments = in_media, photons = static_cast<double>(settings.photons);
    in_media = std::max(segments, std::min(double(kMostOnSegment) * segments, kSegmentPhotons * photons));
  }
  return stored;
}

uint64_t whole_bytes(double bytes) {
  return static_cast<uint64_t>(std::min(bytes, 0x1p63));
}

// A count as --photons takes it, rounded down to two digits, such as "3.4M".
std::string rounded_count(double count) {
  if (count < 1000) return fmt::format("{:.0f}", std::floor(count));
  const double digit = std::pow(10.0, std::floor(std::log10(count)) - 1);
  const double value = std::floor(count / digit) * digit;
  if (value < 1e6) return fmt::format("{:g}k", value / 1e3);
  if (value < 1e9) return fmt::format("{:g}M", value / 1e6);
  return fmt::format("{:g}G", value / 1e9);
}

}  // namespace

std::array<double, kPhotonKinds> estimate_stored(const Scene& scene, const accel::Bvh& bvh,
                                                 const TraceSettings& settings) {
  return scaled_to(settings.photons, shoot_few(scene, bvh, settings));
}

double peak_bytes(const std::array<double, kPhotonKinds>& stored, PhotonUse use) {
  // One map at a time is built from its records, beside the records or maps of the other kinds: see
  // PhotonMap::build.
  constexpr double kRecord = sizeof(PhotonRecord), kMap = 1.1 * kRecord, kBuilt = 52;
  const double all = std::reduce(stored.begin(), stored.end());
  if (use == PhotonUse::kRecords) return kRecord * all;
  const double largest = *std::max_element(stored.begin(), stored.end());
  return kMap * (all - largest) + kBuilt * largest;
}

uint64_t forecast_bytes(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                        PhotonUse use, const GuidedPhotons& guided) {
  return whole_bytes(peak_bytes(estimate_all(scene, bvh, settings, guided), use));
}

void check_memory(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings, PhotonUse use,
                  uint64_t limit, const GuidedPhotons& guided) {
  const double photons = static_cast<double>(settings.photons), bytes_limit = static_cast<double>(limit);
  const double most = photons * most_stored(settings) + most_guided(settings, guided);
  if (most <= kMostInMap && peak_bytes({most}, use) <= bytes_limit) return;

  const auto stored = estimate_all(scene, bvh, settings, guided);
  const double bytes = peak_bytes(stored, use), largest = *std::max_element(stored.begin(), stored.end());
  if (bytes > bytes_limit) {
    throw std::runtime_error(fmt::format(
        "{} photons would need about {} of memory, but {} are available: emit at most about {} at a time, or "
        "store fewer kinds",
        settings.photons, size_text(whole_bytes(bytes)), size_text(limit),
        rounded_count(photons * bytes_limit / bytes)));
  }
  if (use == PhotonUse::kMaps && largest > kMostInMap) {
    throw std::runtime_error(
        fmt::format("{} photons would store about {:.3g} in one map, which holds at most {:.0f}: emit at "
                    "most about {} at a time",
                    settings.photons, largest, kMostInMap, rounded_count(photons * kMostInMap / largest)));
  }
}

uint64_t shoots_that_fit(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                         uint64_t limit, const GuidedPhotons& guided) {
  const double photons = static_cast<double>(settings.photons), bytes_limit = static_cast<double>(limit);
  const double most = photons * most_stored(settings) + most_guided(settings, guided);
  if (most <= kMostInMap && peak_bytes({most}, PhotonUse::kMaps) <= bytes_limit) return 1;
  // A pass may store somewhat more than its share of the estimate.
  constexpr double kMargin = 1.05;
  const auto stored = estimate_all(scene, bvh, settings, guided);
  const double largest = *std::max_element(stored.begin(), stored.end());
  const double shoots =
      std::ceil(kMargin * std::max(peak_bytes(stored, PhotonUse::kMaps) / bytes_limit, largest / kMostInMap));
  if (shoots > photons) throw std::runtime_error("not enough memory for the photon map of a single photon");
  return std::max<uint64_t>(1, static_cast<uint64_t>(shoots));
}

}  // namespace kaustik::photon
