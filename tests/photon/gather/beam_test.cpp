// Compares the search along a ray with one over all photons.

#include "photon/estimate/beam_estimate.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/medium/phase_function.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "tests/support/density_grids.h"
#include "tests/support/packed_flux.h"

namespace kaustik::photon {
namespace {

PhotonMap cloud(uint64_t photons) {
  PhotonBuffer buffer;
  for (uint64_t i = 0; i < photons; ++i) {
    Sampler sampler(11, i);
    Photon photon;
    photon.p = {sampler.next_1d(), sampler.next_1d(), 2 * sampler.next_1d() - 1};
    photon.wi = photon.n = sample_uniform_sphere(sampler.next_2d());
    photon.flux = {1, sampler.next_1d(), 0.5f};
    photon.surface_group = i % 8 == 0 ? 2 : 1;
    buffer.records.push_back(pack(photon, buffer.flux_unit));
  }
  return PhotonMap::build(std::move(buffer));
}

struct Found {
  std::vector<uint32_t> index;
  std::vector<float> t, distance_squared;
};

Found search(const PhotonMap& map, const BeamQuery& query) {
  Found found;
  GatherCounters counters;
  select_along(
      map, query, counters,
      [](void* to, const BeamPhotons& photons) {
        auto& all = *static_cast<Found*>(to);
        all.index.insert(all.index.end(), photons.index, photons.index + photons.size);
        all.t.insert(all.t.end(), photons.t, photons.t + photons.size);
        all.distance_squared.insert(all.distance_squared.end(), photons.distance_squared,
                                    photons.distance_squared + photons.size);
      },
      &found);
  EXPECT_EQ(counters.queries, 1u);
  EXPECT_EQ(counters.accepted, found.index.size());
  EXPECT_GE(counters.candidates, counters.accepted);
  return found;
}

// Where the photon is nearer to the rim or the ends than rounding, it may be found or not.
enum class Expected { kIn, kOut, kEither };
Expected expected(const Photon& photon, const BeamQuery& q) {
  if (photon.surface_group != q.medium) return Expected::kOut;
  const glm::dvec3 from = glm::dvec3(photon.p) - glm::dvec3(q.ray.o), d(q.ray.d);
  const double t = glm::dot(from, d), distance = glm::length(from - t * d), slack = 1e-6;
  const auto between = [&](double r, double s) {
    return distance <= double(q.radius) + r && t >= -s && t <= double(q.distance) + s;
  };
  if (between(-slack, -slack)) return Expected::kIn;
  return between(slack, slack) ? Expected::kEither : Expected::kOut;
}

void expect_the_same(const PhotonMap& map, const BeamQuery& query) {
  const Found found = search(map, query);
  EXPECT_TRUE(std::is_sorted(found.index.begin(), found.index.end()));
  size_t at = 0;
  for (uint32_t i = 0; i < map.size(); ++i) {
    const bool in = at < found.index.size() && found.index[at] == i;
    const Expected wanted = expected(map.photon(i), query);
    if (wanted != Expected::kEither) {
      EXPECT_EQ(in, wanted == Expected::kIn) << i;
    }
    if (!in) continue;
    const Vector3 from = map.photon(i).p - query.ray.o;
    EXPECT_NEAR(found.t[at], glm::dot(from, query.ray.d), 1e-5);
    EXPECT_LE(found.distance_squared[at], query.radius * query.radius);
    ++at;
  }
  EXPECT_EQ(at, found.index.size());
}

TEST(Beam, FindsThePhotonsOfAFullSearch) {
  const PhotonMap map = cloud(20'000);
  size_t all = 0;
  for (uint64_t i = 0; i < 60; ++i) {
    Sampler sampler(12, i);
    const Point3 o(3 * sampler.next_1d() - 1, 3 * sampler.next_1d() - 1, 3 * sampler.next_1d() - 1.5f);
    const Point3 to(sampler.next_1d(), sampler.next_1d(), sampler.next_1d());
    const float distance = i % 3 == 0 ? kInfinity : 2 * sampler.next_1d();
    const BeamQuery query{{o, glm::normalize(to - o)}, distance, i % 5 ? 0.05f : 0.4f, i % 4 ? 1u : 2u};
    expect_the_same(map, query);
    all += search(map, query).index.size();
  }
  EXPECT_GT(all, 10'000u);
}

TEST(Beam, RaysAlongAxesAreNoSpecialCase) {
  const PhotonMap map = cloud(5'000);
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      Vector3 d(0);
      d[axis] = sign;
      expect_the_same(map, {{Point3(0.5f) - d, d}, kInfinity, 0.1f, 1});
      expect_the_same(map, {{Point3(0.5f) - d, d}, 1.25f, 0.1f, 1});
    }
}

TEST(Beam, FindsNothingWhereThereIsNothing) {
  const PhotonMap map = cloud(1'000);
  const Ray ray{{-1, 0.5f, 0}, {1, 0, 0}};
  EXPECT_TRUE(search(PhotonMap(), {ray, kInfinity, 1, 1}).index.empty());
  EXPECT_TRUE(search(map, {ray, 0.9f, 0.4f, 1}).index.empty()) << "ends before the first photon";
  EXPECT_TRUE(search(map, {ray, kInfinity, -1, 1}).index.empty());
  EXPECT_TRUE(search(map, {ray, kInfinity, 10, 3}).index.empty()) << "another medium";
  EXPECT_EQ(search(map, {ray, kInfinity, 10, 1}).index.size(), 875u);
}

// The estimate is the sum over all photons of T p K flux, here for the whole cloud in reach. Columns within
// cells of a grid are interpolated, to 1e-3 m here.
void expect_the_sum(const Medium& medium, double column_error) {
  const PhotonMap map = cloud(3'000);
  BeamQuery query{{{-0.5f, 0.4f, 0.1f}, glm::normalize(Vector3(1, 0.2f, 0.1f))}, kInfinity, 0.3f, 1};
  std::optional<ColumnTable> table;
  if (medium.density) query.columns = &table.emplace(*medium.density, query.ray, kInfinity);
  for (const KernelType type : kKernelTypes) {
    const KernelSpec kernel{type, 1.2f};
    const KernelTerms terms = kernel_terms(kernel, query.radius);
    const Found found = search(map, query);
    glm::dvec3 sum(0);
    for (size_t i = 0; i < found.index.size(); ++i) {
      const Photon photon = map.photon(found.index[i]);
      const double p = double(phase(glm::dot(photon.wi, query.ray.d), medium.g));
      const double k = double(kernel_value(type, terms, found.distance_squared[i]));
      const Rgb left = transmittance(medium, column_of(medium, query.ray, 0, found.t[i]));
      for (int c = 0; c < 3; ++c) sum[c] += p * k * double(left[c]) * double(photon.flux[c]);
    }
    GatherCounters counters;
    const Rgb estimate = estimate_beam(map, query, medium, kernel, 0, counters);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(estimate[c], sum[c], (1e-5 + column_error * double(medium.sigma_t()[c])) * sum[c]) << c;
    EXPECT_GT(sum.x, 0);
  }
  EXPECT_EQ(count_along(map, query), search(map, query).index.size());
}

TEST(Beam, EstimateIsASum) {
  expect_the_sum({{0.5f, 1, 0}, {0.5f, 1, 2}, 0.6f}, 0);
}

TEST(Beam, EstimateIsASumWhereTheDensityChanges) {
  const auto density = test::grid_of({9, 7, 16}, {-0.2, -0.1, -1}, {1.2, 1.1, 1}, [](const glm::dvec3& p) {
    return std::max(2 * std::sin(6 * p.x + p.y) + std::cos(3 * p.z), 0.0);
  });
  expect_the_sum({{0.5f, 1, 0}, {0.5f, 1, 2}, 0.6f, density}, 1e-3);
}

}  // namespace
}  // namespace kaustik::photon
