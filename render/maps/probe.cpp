#include "render/maps/probe.h"

#include <cmath>

#include "photon/gather/gather.h"
#include "photon/gather/kernel.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

// Adds the photons that arrived on the side of n, by the same gather as that of the estimate.
void add_photons(const photon::PhotonMap& map, const photon::EstimateSettings& estimate,
                 const SurfaceInteraction& si, const Normal3& n, ProbedMap* probed) {
  photon::GatherCounters counters;
  photon::GatherQuery query = photon::query_at(map, si, n, estimate, counters);
  if (estimate.leaf) query.within = map.find_cell(si.p, estimate.node_photons, query.radius).range;
  probed->radius = query.radius;
  const photon::KernelTerms terms = photon::kernel_terms(estimate.kernel, query.radius);
  photon::for_each_index(
      map, query,
      [&](uint32_t i, float stretched_squared) {
        const float stretch = query.discs ? query.discs->stretch()[i] : 1;
        const float weight = stretch * photon::kernel_value(estimate.kernel.type, terms, stretched_squared);
        probed->photons.push_back({map.photon(i), std::sqrt(stretched_squared / stretch), weight});
      },
      counters);
}

ProbedMap probe_map(PhotonKind kind, const photon::PhotonMap& map, const photon::EstimateSettings& estimate,
                    const ShadingPoint& x, ProbeUse use) {
  ProbedMap probed{kind, estimate.radius, estimate.kernel, {}, Rgb(0), use};
  if (map.empty()) return probed;
  const Normal3 n = glm::dot(x.wo, x.si.n) < 0 ? -x.si.n : x.si.n;
  if (transmits(*x.bsdf)) add_photons(map, estimate, x.si, -n, &probed);
  add_photons(map, estimate, x.si, n, &probed);
  photon::GatherCounters counters;
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
  const EstimatorPlan& plan = input.plan;
  const photon::KindMask kinds = kinds_needed(plan);
  const auto add = [&](PhotonKind kind, const photon::PhotonMap& map,
                       const photon::EstimateSettings& estimate,
                       ProbeUse use) { probe->maps.push_back(probe_map(kind, map, estimate, x, use)); };
  const bool lecture = plan.direct == DirectEstimator::kLecture;
  if (lecture && !maps.direct.map.empty()) probe->cell = probe_cell(maps, x.si.p);
  const bool refused = lecture && !(probe->cell && probe->cell->answer.use_photons());
  if (kinds.direct)
    add(PhotonKind::kDirect, maps.direct.map, maps.direct.estimate,
        refused ? ProbeUse::kRefused : ProbeUse::kAdded);
  if (kinds.shadow)
    add(PhotonKind::kShadow, maps.shadow, maps.direct.estimate,
        lecture ? ProbeUse::kTested : ProbeUse::kSubtracted);
  if (kinds.caustic) add(PhotonKind::kCaustic, maps.caustic.map, maps.caustic.estimate, ProbeUse::kAdded);
  if (kinds.indirect) add(PhotonKind::kIndirect, maps.indirect.map, maps.indirect.estimate, ProbeUse::kAdded);
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
