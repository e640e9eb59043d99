#pragma once
// Compares the light of photons and paths, class by class. Differences are compared with the measured noise
// of several seeds and a kernel bias measured by halving the radius: an estimate whose bias falls at least
// linearly with r has |bias(r)| <= 2 |estimate(r) - estimate(r/2)|.

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"

namespace kaustik::test {

inline constexpr int kSeeds = 6;
// With 10 degrees of freedom a difference exceeds 5 standard errors less than once in 1000.
inline constexpr double kErrors = 5;
inline constexpr int kSize = 24, kBlock = 8;
inline constexpr std::array<Layer, 3> kClasses = {Layer::kDirect, Layer::kCaustic, Layer::kIndirect};

// Mean of one class over a square block of pixels, or over the image (block < 0).
inline double block_mean(const Film& film, Layer layer, int block) {
  if (block < 0) return layer_mean(film, layer);
  const int columns = film.width() / kBlock;
  Film part(kBlock, kBlock);
  for (int y = 0; y < kBlock; ++y)
    for (int x = 0; x < kBlock; ++x)
      part.at(x, y) = film.at(block % columns * kBlock + x, block / columns * kBlock + y);
  return layer_mean(part, layer);
}

inline std::vector<Film> films(const Scene& scene, RenderSettings settings, int seeds = kSeeds) {
  std::vector<Film> out;
  const uint64_t first = settings.seed;
  for (int i = 0; i < seeds; ++i) {
    settings.seed = first + uint64_t(i);
    out.push_back(render_with_threads(scene, settings).film);
  }
  return out;
}

inline Estimate block_estimate(const std::vector<Film>& of, Layer layer, int block) {
  std::vector<double> means;
  for (const Film& film : of) means.push_back(block_mean(film, layer, block));
  return estimate_of(means);
}

inline RenderSettings settings_of(Method method, int spp, float radius, uint64_t seed) {
  RenderSettings settings;
  settings.method = method;
  settings.spp = spp;
  settings.photons = 200'000;
  settings.radius = radius;
  settings.seed = seed;
  return settings;
}

// The settings with photons alone where method auto would divide light between them and paths.
inline RenderSettings by_photons(RenderSettings settings) {
  if (settings.method != Method::kAuto) return settings;
  settings.caustics = CausticEstimator::kPhotons, settings.indirect = IndirectEstimator::kPhotons;
  return settings;
}

// Largest relative error of a mean over channels that packed fluxes cause here: each channel is off by up to
// kPackedFluxError of the largest one. The light of the box is (17, 12, 4), so this is at most 17/4 of that,
// on a surface that reflects blue only.
inline constexpr double kPackedLight = 17.0 / 4 * kPackedFluxError;

// The films of a scene by paths, and by a photon method at the full and at half the radius.
struct Comparison {
  const std::vector<Film>& mc;
  std::vector<Film> photons, half;

  Comparison(const Scene& scene, const std::vector<Film>& by_paths, Method method, float radius)
      : mc(by_paths),
        photons(films(scene, by_photons(settings_of(method, 16, radius, 200)))),
        half(films(scene, by_photons(settings_of(method, 16, radius / 2, 300)))) {}

  void expect_agreement(Layer layer, int block, double meaningful = 0.25) const {
    const Estimate reference = block_estimate(mc, layer, block),
                   found = block_estimate(photons, layer, block);
    const Estimate smaller = block_estimate(half, layer, block);
    const double noise =
        std::hypot(reference.standard_error, found.standard_error, 2 * smaller.standard_error);
    const double bias = 2 * std::abs(found.mean - smaller.mean) + kPackedLight * reference.mean;
    EXPECT_NEAR(found.mean, reference.mean, kErrors * noise + bias)
        << kLayerNames[size_t(layer)] << " block " << block << " noise " << noise << " bias " << bias;
    if (block < 0) {
      // The test is sensitive: noise and bias are small against the light.
      EXPECT_LT(kErrors * noise + bias, meaningful * reference.mean) << kLayerNames[size_t(layer)];
    }
  }

  void expect_agreement_everywhere(Layer layer) const {
    for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block) expect_agreement(layer, block);
  }

  void write_pictures(const std::string& name) const {
    write_if_failed(mc[0], name + "_mc");
    write_if_failed(photons[0], name + "_photons");
  }
};

// The mean over whole pictures and all classes.
inline Estimate total(const std::vector<Film>& of) {
  std::vector<double> means;
  for (const Film& film : of) means.push_back(total_mean(film));
  return estimate_of(means);
}

// The settings combined with every way to estimate direct, caustic and indirect light; sources are
// divided only beside the direct light that method auto combines that with.
inline std::vector<RenderSettings> with_all_estimators(RenderSettings settings) {
  settings.photons = 100'000;
  std::vector<RenderSettings> all;
  for (const auto direct : {DirectEstimator::kShadowRays, DirectEstimator::kPhotons,
                            DirectEstimator::kLecture, DirectEstimator::kPredicted, DirectEstimator::kSigned})
    for (const auto caustics :
         {CausticEstimator::kPhotons, CausticEstimator::kPaths, CausticEstimator::kSplit})
      for (const auto indirect :
           {IndirectEstimator::kPaths, IndirectEstimator::kPhotons, IndirectEstimator::kSplit}) {
        const bool split = caustics == CausticEstimator::kSplit || indirect == IndirectEstimator::kSplit;
        if (split && direct != DirectEstimator::kPredicted) continue;
        settings.direct = direct;
        settings.caustics = caustics;
        settings.indirect = indirect;
        all.push_back(settings);
      }
  return all;
}
// As above, but only so many that each two estimators of different classes meet (divided sources, as
// above, only predicted direct light): half as many renders, and the full product is left to OneOwner's test.
inline std::vector<RenderSettings> with_pairs_of_estimators(const RenderSettings& settings) {
  std::vector<RenderSettings> pairs = with_all_estimators(settings);
  std::erase_if(pairs, [](const RenderSettings& s) {
    if (s.indirect == IndirectEstimator::kSplit || s.caustics == CausticEstimator::kSplit) return false;
    const int parity = int(*s.direct) + int(s.caustics == CausticEstimator::kPaths) +
                       int(s.indirect == IndirectEstimator::kPaths);
    return parity % 2 == 1;
  });
  return pairs;
}

inline std::string names_of_estimators(const RenderSettings& s) {
  return std::to_string(int(*s.direct)) + std::to_string(int(*s.caustics)) + std::to_string(int(*s.indirect));
}

// The mean of one class of paths, or of all classes (no layer), by paths and by photons with two radii.
struct ClassReference {
  std::optional<Layer> layer;
  Estimate paths, wide, narrow;

  static Estimate mean_of(const std::vector<Film>& of, std::optional<Layer> layer) {
    return layer ? block_estimate(of, *layer, -1) : total(of);
  }
  ClassReference(std::optional<Layer> of, const std::vector<Film>& mc, const std::vector<Film>& photons,
                 const std::vector<Film>& half_radius)
      : layer(of), paths(mean_of(mc, of)), wide(mean_of(photons, of)), narrow(mean_of(half_radius, of)) {}

  // The tolerance must be below the class itself, so that a class that is missing or counted twice fails.
  // `sum` is the mean of all classes: those below a twentieth of it may be too noisy for that.
  void expect_agreement(const std::vector<Film>& films, const std::string& estimators, double sum) const {
    const Estimate found = mean_of(films, layer);
    const double noise = 6 * std::hypot(paths.standard_error, found.standard_error);
    const double bias = kPackedLight * paths.mean + 2 * std::abs(wide.mean - narrow.mean) +
                        kErrors * std::hypot(wide.standard_error, narrow.standard_error);
    const std::string what = estimators + " " + (layer ? std::string(kLayerNames[size_t(*layer)]) : "sum");
    EXPECT_NEAR(found.mean, paths.mean, noise + bias) << what << " noise " << noise << " bias " << bias;
    if (paths.mean > 0.05 * sum) {
      EXPECT_LT(noise + bias, (layer ? 1 : 0.5) * paths.mean) << what;
    }
  }
};

// Every path is counted once, whichever estimators are chosen: the means of each class and of their sum are
// those of paths, but for noise and the kernels' bias.
inline void expect_the_same_sum_by_all_estimators(const Scene& scene, float radius) {
  const auto by_paths = films(scene, settings_of(Method::kMc, 128, radius, 1));
  const auto wide = films(scene, settings_of(Method::kPhoton, 16, radius, 20));
  const auto narrow = films(scene, settings_of(Method::kPhoton, 16, radius / 2, 30));
  std::vector<ClassReference> references = {{{}, by_paths, wide, narrow}};
  for (const Layer layer : kClasses)
    if (block_estimate(by_paths, layer, -1).mean > 0) references.push_back({layer, by_paths, wide, narrow});
  for (const RenderSettings& settings :
       with_pairs_of_estimators(settings_of(Method::kAuto, 16, radius, 10))) {
    const auto found = films(scene, settings, 4);
    for (const ClassReference& reference : references)
      reference.expect_agreement(found, names_of_estimators(settings), references[0].paths.mean);
  }
}

}  // namespace kaustik::test
