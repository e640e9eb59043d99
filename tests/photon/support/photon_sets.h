#pragma once
// Sets of photons, random and degenerate, for the tests of maps and searches.

#include <ostream>
#include <string>
#include <vector>

#include "photon/gather/gather_query.h"
#include "photon/map/photon_map.h"
#include "tests/support/random.h"

namespace kaustik::photon {

struct PhotonSet {
  std::string name;
  std::vector<Photon> photons;
};
// GoogleTest lists the test of a set under this name.
inline void PrintTo(const PhotonSet& set, std::ostream* out) {
  *out << set.name;
}

// Random photons.
class PhotonMaker : public test::Random {
 public:
  using Random::Random;

  Photon at(const Point3& p, const Normal3& n, uint32_t group) {
    const Vector3 w = direction();
    return {p, glm::dot(w, n) < 0 ? -w : w, Rgb(uniform(), uniform(), uniform()), n, group};
  }
  // On the walls of the box [0, 4] x [0, 3] x [0, 2], one group per axis, normals inwards.
  Photon on_wall() {
    const Vector3 size(4, 3, 2);
    const int axis = int(bits() % 3);
    const bool high = bits() & 1;
    Point3 p(uniform() * size.x, uniform() * size.y, uniform() * size.z);
    p[axis] = high ? size[axis] : 0.0f;
    Normal3 n(0);
    n[axis] = high ? -1.0f : 1.0f;
    return at(p, n, uint32_t(axis));
  }
};

inline std::vector<PhotonSet> photon_sets() {
  PhotonMaker make(1);
  std::vector<PhotonSet> sets;
  const auto add = [&](std::string name, int count, auto&& one) {
    PhotonSet set{std::move(name), {}};
    for (int i = 0; i < count; ++i) set.photons.push_back(one(i));
    sets.push_back(std::move(set));
  };
  const Normal3 up(0, 0, 1);
  add("none", 0, [&](int) { return Photon{}; });
  add("one", 1, [&](int) { return make.at({1.5f, -2, 3}, up, 7); });
  add("one point", 1000, [&](int) { return make.at({1.5f, -2, 3}, up, 7); });
  add("line", 2000, [&](int) { return make.at({make.uniform(), 0.25f, -1}, up, 0); });
  add("even line", 1025, [&](int i) { return make.at({0.125f * float(i), 0, 0}, up, 0); });
  add("plane", 5000, [&](int) { return make.at({make.uniform(), make.uniform(), 2}, up, 1); });
  add("grid", 4096, [&](int i) { return make.at(Point3(i & 15, i >> 4 & 15, i >> 8), up, uint32_t(i & 1)); });
  add("volume", 5000, [&](int) {
    return make.at({make.uniform(), make.uniform(), make.uniform()}, make.direction(), make.bits() % 3);
  });
  add("walls", 20000, [&](int) { return make.on_wall(); });
  add("two clusters", 4000,
      [&](int i) { return make.at(Point3(i & 1 ? 1e6f : 0.0f) + 1e-3f * make.direction(), up, 0); });
  add("flux in one group above 2^16", 100, [&](int) { return make.at(make.direction(), up, 65537); });
  return sets;
}

inline PhotonBuffer make_buffer(const std::vector<Photon>& photons, float flux_unit = 1) {
  PhotonBuffer buffer{{}, flux_unit};
  for (const Photon& photon : photons) buffer.records.push_back(pack(photon, flux_unit));
  return buffer;
}

// Queries inside, near and far outside the set; on photons and between them.
inline std::vector<GatherQuery> queries_for(const PhotonSet& set, int count) {
  PhotonMaker make(2);
  Bounds3 bounds;
  for (const Photon& photon : set.photons) bounds.add(photon.p);
  if (bounds.empty()) bounds.add(Point3(0));
  const float size = std::max(max_component(bounds.diagonal()), 0.5f);
  const float radii[] = {0, 0.001f, 0.02f, 0.1f, 0.5f, 10};  // of the size
  std::vector<GatherQuery> queries;
  for (int i = 0; i < count; ++i) {
    const Photon near = set.photons.empty() ? Photon{} : set.photons[make.bits() % set.photons.size()];
    GatherQuery query{near.p, near.n, near.surface_group, radii[i % 6] * size, kAllPhotons};
    if (set.photons.empty()) query.n = {0, 0, 1};
    if (i % 4 == 1) query.p += 0.1f * size * make.direction();
    if (i % 4 == 2)
      query.p = bounds.min + 1.2f * size * Vector3(make.uniform(), make.uniform(), make.uniform());
    if (i % 4 == 3) query.n = glm::normalize(query.n + 0.8f * make.direction());
    if (i % 29 == 0) query.p += 1000.0f * size * make.direction();
    queries.push_back(query);
  }
  return queries;
}

}  // namespace kaustik::photon
