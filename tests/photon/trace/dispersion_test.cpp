// Tests what dispersive glass makes of photons.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/sampling/sampler.h"
#include "tests/photon/support/trace_scenes.h"

namespace kaustik::photon {
namespace {

// The room with a ball of glass that disperses.
Scene room_with_prism() {
  Scene scene = test::full_room();
  scene.materials[1].disperse(std::make_shared<const Spectrum>(abbe_index(1.5, 20)));
  finalize_scene(scene);
  return scene;
}

// All photons by the index of the one that left them.
std::map<uint64_t, std::vector<Photon>> by_index(const Scene& scene, const TraceSettings& settings) {
  std::map<uint64_t, std::vector<Photon>> photons;
  const accel::Bvh bvh(scene);
  TraceCounters counters;
  const auto sink = [&](PhotonKind, const Photon& p, uint64_t index) { photons[index].push_back(p); };
  trace_photons(scene, bvh, settings, 0, settings.photons, sink, counters);
  EXPECT_EQ(counters.energy.unaccounted(), 0);
  return photons;
}

TEST(DispersedPhotons, PartsOfAPhotonDivideTheSpectrumEvenly) {
  const TraceSettings settings = test::settings_for(20'000, {false, false, true, false});
  size_t whole = 0, white = 0;
  for (const auto& [index, photons] : by_index(room_with_prism(), settings)) {
    const float first = Sampler(photon_stream(settings), index, kWavelengthDimension).next_1d();
    std::set<float> possible, found;
    for (int part = 0; part < 4; ++part) {
      const float u = first + 0.25f * float(part);
      possible.insert(sample_wavelength(u < 1 ? u : u - 1));
    }
    for (const Photon& p : photons) {
      if (p.wavelength == kNoWavelength) {
        ++white;
        continue;
      }
      EXPECT_TRUE(possible.contains(p.wavelength)) << p.wavelength;
      EXPECT_TRUE(found.insert(p.wavelength).second) << "one of each part";
      EXPECT_EQ(p.flux, photons[0].flux);
    }
    whole += found.size() == 4;
  }
  EXPECT_GT(whole, 100u);
  EXPECT_GT(white, 100u);  // from the mirror, and reflected by the glass
}

// Glass that disperses nothing refracts all parts alike, so that they add up to the photon that is not
// divided. The faces choose by the same random numbers.
TEST(DispersedPhotons, PartsAddUpToTheWholePhoton) {
  const TraceSettings settings = test::settings_for(20'000, {false, false, true, false});
  Scene scene = room_with_prism();
  const auto undivided = [&] {
    Scene plain = test::full_room();
    return by_index(plain, settings);
  }();
  scene.materials[1].disperse(std::make_shared<const Spectrum>(cauchy_index(std::array{1.5})));
  const auto divided = by_index(scene, settings);
  ASSERT_EQ(divided.size(), undivided.size());
  for (const auto& [index, photons] : divided) {
    const auto& one = undivided.at(index);
    Rgb sum(0);
    for (const Photon& p : photons) sum += p.flux;
    EXPECT_EQ(sum, one[0].flux);  // exact: quarters of floats
    EXPECT_TRUE(photons.size() == 1 || photons.size() == 4);
    for (const Photon& p : photons) EXPECT_EQ(p.p, one[0].p);
  }
}

}  // namespace
}  // namespace kaustik::photon
