#include "render/maps/probe.h"

#include <cmath>

#include "photon/gather/gather.h"
#include "photon/gather/kernel.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

// The same gather as that of the estimate, photon by photon. Photons behind walls are not left out.
ProbedMap probe_map(PhotonKind kind, const photon::PhotonMap& map, const photon::EstimateSettings& estimate,
                    const ShadingPoint& x) {
  ProbedMap probed{kind, estimate.radius, estimate.kernel, {}, Rgb(0)};
  if (map.empty()) return probed;
  photon::GatherCounters counters;
  const Normal3 n = glm::dot(x.wo, x.si.n) < 0 ? -x.si.n : x.si.n;
  photon::GatherQuery query{x.si.p, n, x.si.surface_group, estimate.radius, photon::kAllPhotons};
  if (estimate.nearest > 0) query.radius = photon::disc_of_nearest(map, query, estimate.nearest, counters);
  if (estimate.leaf) query.within = map.find_cell(x.si.p, estimate.node_photons, query.radius).range;
  probed.radius = query.radius;
  const photon::KernelTerms terms = photon::kernel_terms(estimate.kernel, query.radius);
  photon::for_each_photon(
      map, query,
      [&](const photon::Photon& p, float distance_squared) {
        const float weight = photon::kernel_value(estimate.kernel.type, terms, distance_squared);
        probed.photons.push_back({p, std::sqrt(distance_squared), weight});
      },
      counters);
  probed.radiance = photon::estimate_radiance(map, x.si, x.wo, *x.bsdf, estimate, counters);
  return probed;
}

ProbedCell probe_cell(const PhotonMaps& maps, const Point3& p) {
  ProbedCell cell;
  cell.answer = photon::lecture_lookup(maps.direct.map, maps.shadow, p, maps.lecture);
  const photon::MortonCube& cube = maps.direct.map.cube();
  cell.bounds = cube.cell_bounds(cube.cell(p), cell.answer.depth);
  cell.direct = cell.answer.photons();
  photon::PhotonRange ranges[photon::kMortonBits + 1];
  const int depth = maps.shadow.octree().descend(
      maps.shadow.positions(), photon::morton_key(cube.cell(p)), ranges,
      [&](int at, const photon::PhotonRange&) { return at == cell.answer.depth; });
  cell.shadow = ranges[depth].size();
  return cell;
}

void probe_point(const RenderInput& input, const PhotonMaps& maps, const ShadingPoint& x, Probe* probe) {
  const photon::KindMask kinds = kinds_needed(input.plan);
  if (kinds.direct)
    probe->maps.push_back(probe_map(PhotonKind::kDirect, maps.direct.map, maps.direct.estimate, x));
  if (kinds.shadow)
    probe->maps.push_back(probe_map(PhotonKind::kShadow, maps.shadow, maps.direct.estimate, x));
  if (kinds.caustic)
    probe->maps.push_back(probe_map(PhotonKind::kCaustic, maps.caustic.map, maps.caustic.estimate, x));
  if (kinds.indirect)
    probe->maps.push_back(probe_map(PhotonKind::kIndirect, maps.indirect.map, maps.indirect.estimate, x));
  if (input.plan.direct == DirectEstimator::kLecture && !maps.direct.map.empty())
    probe->cell = probe_cell(maps, x.si.p);
}

}  // namespace

Probe probe_pixel(const RenderInput& input, const PhotonMaps& maps, int x, int y) {
  const Scene& scene = input.scene;
  Probe probe;
  Sampler sampler(0, 0);
  Ray ray = scene.camera.generate_ray({float(x) + 0.5f, float(y) + 0.5f});
  for (;; ++probe.specular) {
    const Hit hit = input.bvh.intersect(ray);
    if (!hit.valid()) return probe;
    const ShadingPoint point(scene, make_interaction(scene.shapes, ray, hit), -ray.d);
    probe.distance += hit.t;
    const Lobes parts = lobes(*point.bsdf);
    if (parts.diffuse || !parts.specular || probe.specular == input.settings.max_bounces) {
      probe.point = point.si;
      probe_point(input, maps, point, &probe);
      return probe;
    }
    const auto next = parts.glossy ? scatter(point, sampler) : scatter_delta(point, 0.5f);
    if (!next) return probe;
    ray = point.si.spawn(next->wi);
  }
}

}  // namespace kaustik::render
