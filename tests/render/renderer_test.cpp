// Tests what render() promises besides the picture: invalid samples, cancelling, bad settings, statistics.

#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/stopwatch.h"
#include "render/statistics_json.h"
#include "render/tiles/tiles.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

// The left half of the floor reflects NaN.
Scene half_broken(const Rgb& reflectance) {
  Scene scene;
  const uint32_t good = add_material(scene, Lambertian{Rgb(0.5f)});
  const uint32_t bad = add_material(scene, Lambertian{reflectance});
  add_shape(scene, horizontal({-1, 0, 0}, 1, 2, true, bad));
  add_shape(scene, horizontal({1, 0, 0}, 1, 2, true, good));
  scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(1)});
  look_at(scene, {0, 3, 0}, {0, 0, 0}, {0, 0, -1}, 30, 8, 8);
  finalize_scene(scene);
  return scene;
}

TEST(InvalidSamples, AreDroppedCountedAndNamed) {
  for (const float value : {std::nanf(""), -1.0f, kInfinity}) {
    RenderSettings settings;
    settings.method = Method::kRaytrace;
    settings.spp = 2;
    settings.adaptive = 0;
    const auto result = render_with_threads(half_broken(Rgb(value)), settings, 3);
    EXPECT_EQ(result.statistics.dropped_samples, 8u * 4u * 2u) << value;
    ASSERT_EQ(result.statistics.dropped_examples.size(), 10u);
    EXPECT_EQ(result.statistics.dropped_examples[0].text(), "pixel 0 0 sample 0");
    EXPECT_EQ(result.statistics.dropped_examples[9].text(), "pixel 0 1 sample 1");
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Rgb L = result.film.at(x, y).radiance();
        EXPECT_TRUE(x < 4 ? is_black(L) : L.x > 0 && is_finite(L)) << x << " " << y;
      }
  }
}

TEST(Render, CancelsInEveryPhase) {
  const Scene scene = cornell(40);
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.photons = 50'000;
  settings.spp = 1;
  const accel::Bvh bvh(scene);
  for (const std::string_view phase : {"photons", "build", "render"}) {
    const auto result = render(scene, bvh, settings, [&](const Progress& p) { return p.phase != phase; });
    EXPECT_TRUE(result.cancelled) << phase;
  }
  EXPECT_FALSE(render(scene, bvh, settings).cancelled);
}

// A cancelled pass leaves no trace in the complete ones; before the first pass is complete, its tiles are
// shown.
TEST(Render, CancelledPassDoesNotCount) {
  const Scene scene = cornell(40);
  const accel::Bvh bvh(scene);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = 4;
  settings.passes = 4;
  const auto cancel_at = [&](uint64_t pass, uint64_t tiles) {
    return render(scene, bvh, settings, [=](const Progress& p) { return p.pass != pass || p.done < tiles; });
  };
  const auto in_third = cancel_at(2, 3);
  EXPECT_TRUE(in_third.cancelled);
  EXPECT_EQ(in_third.shown, Shown::kPasses);
  EXPECT_EQ(in_third.sums.passes, PassSet(0, 2));
  EXPECT_EQ(in_third.statistics.rays.camera, 2u * 40 * 40);
  settings.spp = 2;
  settings.passes = 2;
  const auto two = render(scene, bvh, settings);
  EXPECT_EQ(std::memcmp(&two.film.at(0, 0), &in_third.film.at(0, 0), sizeof(PixelResult) * 40 * 40), 0);

  const auto in_first = cancel_at(0, 1);
  EXPECT_EQ(in_first.shown, Shown::kTiles);
  EXPECT_TRUE(in_first.sums.passes.empty());
  EXPECT_GT(in_first.film.at(0, 0).depth, 0);
  EXPECT_EQ(in_first.film.at(39, 39).depth, 0);
  EXPECT_EQ(in_first.statistics.passes, 0u);
  EXPECT_EQ(render(scene, bvh, settings, [](const Progress&) { return true; }).shown, Shown::kPasses);
}

TEST(Render, ReportsEveryTile) {
  const Scene scene = cornell(40);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = 1;
  for (const bool adaptive : {false, true}) {
    settings.adaptive = adaptive ? 0.75f : 0;
    const uint64_t tiles = adaptive ? 50 : 25;  // 40 pixels are five tiles of 8, rendered once or twice
    uint64_t last = 0;
    render(scene, accel::Bvh(scene), settings, [&](const Progress& p) {
      EXPECT_EQ(p.phase, "render");
      EXPECT_EQ(p.total, tiles);
      EXPECT_TRUE(p.done == last || p.done == last + 1);  // equal at the start, and within long tiles
      last = p.done;
      return true;
    });
    EXPECT_EQ(last, tiles);
  }
}

// The samples of the only tile would take days.
TEST(Render, CancelsWithinATile) {
  const Scene scene = cornell(kTileSize);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = 1'000'000'000;
  const auto cut = render(scene, accel::Bvh(scene), settings,
                          [asked = 0](const Progress&) mutable { return ++asked < 3; });
  EXPECT_TRUE(cut.cancelled);
  EXPECT_EQ(cut.shown, Shown::kNothing);
  EXPECT_EQ(cut.statistics.rays.camera, 0u);
}

// At its end the only tile of a pass completes the pass, and it is the next one that is cancelled.
TEST(Render, CancelsBetweenPassesOfASingleTile) {
  const Scene scene = cornell(kTileSize);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = settings.passes = 1000;
  const auto cut = render(scene, accel::Bvh(scene), settings, [stop = false](const Progress& p) mutable {
    stop |= p.pass == 2 && p.done == 1;
    return !stop;
  });
  EXPECT_TRUE(cut.cancelled);
  EXPECT_EQ(cut.shown, Shown::kPasses);
  EXPECT_EQ(cut.sums.passes, PassSet(0, 3));
}

// A tile that is cancelled among its adaptive samples keeps the first ones alone.
TEST(Render, CancelledTileKeepsItsFirstSamples) {
  const Scene scene = cornell(kTileSize);
  const accel::Bvh bvh(scene);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = 1024;
  settings.adaptive = 0;
  // So many samples that the adaptive ones, of which there are three quarters as many, take longer than the
  // tenth of a second between two calls: the second call that follows the first samples comes within the
  // tile.
  RenderResult first;
  for (double seconds = 0; seconds < 1;) {
    settings.spp *= 2;
    const Stopwatch watch;
    first = render(scene, bvh, settings);
    seconds = watch.seconds();
  }
  settings.adaptive = 0.75f;
  const auto cut = render(scene, bvh, settings,
                          [within = 0](const Progress& p) mutable { return p.done < 1 || ++within < 2; });
  EXPECT_TRUE(cut.cancelled);
  EXPECT_EQ(cut.shown, Shown::kTiles);
  for (int y = 0; y < kTileSize; ++y)
    for (int x = 0; x < kTileSize; ++x)
      EXPECT_EQ(cut.film.at(x, y).radiance(), first.film.at(x, y).radiance()) << x << " " << y;
}

// A render that is cancelled among adaptive samples shows all finished work.
TEST(Render, CancelledAmongAdaptiveSamplesKeepsTheFirst) {
  const Scene scene = cornell(40);
  RenderSettings settings;
  settings.method = Method::kRaytrace;
  settings.spp = 2;
  const accel::Bvh bvh(scene);
  const auto whole = render(scene, bvh, settings);
  for (const uint64_t at : {25u, 27u}) {  // the first samples have 25 tiles
    const auto cut = render(scene, bvh, settings, [&](const Progress& p) { return p.done < at; });
    EXPECT_TRUE(cut.cancelled);
    EXPECT_EQ(cut.shown, Shown::kTiles);
    EXPECT_NEAR(total_mean(cut.film), total_mean(whole.film), 0.1 * total_mean(whole.film));
  }
}

TEST(Render, RefusesSenselessSettings) {
  const Scene scene = cornell(8);
  const accel::Bvh bvh(scene);
  const auto refused = [&](auto change) {
    RenderSettings settings;
    settings.method = Method::kRaytrace;
    change(settings);
    EXPECT_THROW(render(scene, bvh, settings), std::invalid_argument);
  };
  refused([](RenderSettings& s) { s.spp = 0; });
  refused([](RenderSettings& s) { s.max_bounces = 0; });
  refused([](RenderSettings& s) { s.radius = 0.0f; });
  refused([](RenderSettings& s) { s.radius = std::nanf(""); });
  refused([](RenderSettings& s) { s.alpha = 0; });
  refused([](RenderSettings& s) { s.alpha = 1.5f; });
  refused([](RenderSettings& s) { s.crop = {0, 9, 0, 8}; });
  refused([](RenderSettings& s) { s.crop = {-1, 4, 0, 8}; });
}

// Paths of one event carry direct light only; a scene without lights is black by every method.
TEST(Render, OneBounceIsDirectLightAndNoLightsAreBlack) {
  Scene scene = cornell(16);
  RenderSettings settings;
  settings.method = Method::kMc;
  settings.spp = 8;
  settings.max_bounces = 1;
  const auto direct_only = render_with_threads(scene, settings);
  EXPECT_GT(layer_mean(direct_only.film, Layer::kDirect), 0);
  EXPECT_EQ(layer_mean(direct_only.film, Layer::kIndirect), 0);
  EXPECT_EQ(layer_mean(direct_only.film, Layer::kCaustic), 0);

  scene.lights.clear();
  for (Shape& shape : scene.shapes) shape.light = kNoIndex;
  finalize_scene(scene);
  for (const Method method :
       {Method::kAuto, Method::kRaytrace, Method::kMc, Method::kHybrid, Method::kPhoton}) {
    settings.method = method;
    settings.photons = 1000;
    const auto dark = render_with_threads(scene, settings);
    EXPECT_EQ(total_mean(dark.film), 0);
    EXPECT_GT(dark.film.at(8, 8).depth, 0);
  }
}

// By the pilot's rule about 64 photons are in reach of a typical visible point, for any number of photons.
TEST(AutoRadius, GathersAboutSixtyFourPhotons) {
  const Scene scene = cornell(24);
  for (const uint64_t photons : {20'000u, 200'000u}) {
    RenderSettings settings;
    settings.method = Method::kPhoton;
    settings.caustics = CausticEstimator::kOff;
    settings.indirect = IndirectEstimator::kOff;
    settings.photons = photons;
    settings.spp = 1;
    const auto result = render_with_threads(scene, settings);
    EXPECT_GT(result.statistics.radius, 0);
    EXPECT_EQ(result.statistics.radius, result.statistics.direct_radius);
    EXPECT_EQ(result.statistics.caustic_radius, 0);
    std::vector<float> counts;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) counts.push_back(result.film.at(x, y).photons);
    std::nth_element(counts.begin(), counts.begin() + counts.size() / 2, counts.end());
    // The radius is the median over 1024 pilot points of the radius that holds 64 photons; 576 pixels and the
    // direct light's variation over the scene leave the median count within a factor of two.
    EXPECT_GT(counts[counts.size() / 2], 32);
    EXPECT_LT(counts[counts.size() / 2], 128);
  }
}

TEST(Statistics, JsonContainsTheCounts) {
  const Scene scene = cornell_with_table(16);
  RenderSettings settings;
  settings.method = Method::kHybrid;
  settings.photons = 20'000;
  settings.spp = 2;
  settings.seed = 0xffffffffffffffffull;
  const auto result = render_with_threads(scene, settings);
  OuterTimes times;
  times.load = 0.5;
  times.total = 3;
  nlohmann::ordered_json shown;
  shown["direct"] = "lecture";
  const auto json =
      nlohmann::json::parse(statistics_json(result, settings, shown, scene.needs, times, nullptr));
  EXPECT_EQ(json["seed"].get<uint64_t>(), settings.seed);
  EXPECT_EQ(json["photons"]["emitted"].get<uint64_t>(), 20'000u);
  EXPECT_EQ(json["pass_ranges"], "0:1");
  for (const char* kind : {"direct", "shadow", "caustic"})
    EXPECT_GT(json["photons"]["stored"][kind], 0) << kind;
  EXPECT_EQ(json["photons"]["stored"]["indirect"], 0);
  EXPECT_EQ(json["rays"]["camera"], 16 * 16 * 2);
  for (const char* ray : {"specular", "shadow", "bounce", "photon", "photon_shadow"})
    EXPECT_GT(json["rays"][ray], 0);
  for (const char* phase : {"load", "bvh", "photon_trace", "photon_build", "render", "write", "total"})
    EXPECT_TRUE(json["seconds"][phase].is_number()) << phase;
  EXPECT_EQ(json["seconds"]["load"], 0.5);
  EXPECT_GT(json["peak_memory_bytes"].get<uint64_t>(), 1'000'000u);
  EXPECT_GT(json["radius"], 0);
  EXPECT_TRUE(json["needs"]["specular"]);
  EXPECT_EQ(json["settings"]["direct"], "lecture");
  EXPECT_TRUE(json["left_out"].is_array());
  EXPECT_GT(
      json["fallbacks"]["from_photons"].get<uint64_t>() + json["fallbacks"]["fallback_few"].get<uint64_t>(),
      0u);
}

// Equal renders give equal files.
TEST(Statistics, MetadataIsReproducible) {
  const Scene scene = cornell(8);
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.photons = 4999;  // rounded up
  settings.spp = 1;
  settings.passes = 3;
  settings.alpha = 0.5f;
  nlohmann::ordered_json shown;
  shown["method"] = "photon";
  shown["alpha"] = 0.5;
  const auto a = metadata_of(render_with_threads(scene, settings, 1), settings, shown);
  const auto b = metadata_of(render_with_threads(scene, settings, 2), settings, shown);
  EXPECT_EQ(a, b);
  const auto has = [&](const std::string& key, const std::string& value) {
    return std::find(a.begin(), a.end(), std::make_pair(key, value)) != a.end();
  };
  EXPECT_TRUE(has("kaustik:method", "photon"));
  EXPECT_TRUE(has("kaustik:photons_emitted", "5001"));
  EXPECT_TRUE(has("kaustik:passes", "3"));
  EXPECT_TRUE(has("kaustik:pass_ranges", "0:3"));
  EXPECT_TRUE(has("kaustik:passes_of_settings", "3"));
  EXPECT_TRUE(has("kaustik:alpha", "0.5"));
}

}  // namespace
}  // namespace kaustik::render
