// Explores the open directions by rays over the cosine-weighted hemisphere and by samples of the lights.

#include "render/explore/sky_guide.h"

#include <algorithm>
#include <map>

#include "core/parallel/parallel.h"
#include "core/sampling/equal_area.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from all others.
constexpr uint64_t kSkyStream = 0x5C1E5;
constexpr int kSide = 16;  // directions are divided into kSide^2 cells of equal solid angle
constexpr int kSkyRays = 16;
constexpr double kLittle = 0.15;  // of the light, where samples gain by more than they cost
constexpr float kCellsPerSteradian = float(kSide * kSide) / (4 * kPi);

uint32_t cell_of(const Vector3& w) {
  const Point2 p = equal_area_sphere_to_square(w);
  const auto at = [](float v) { return std::clamp(int(v * kSide), 0, kSide - 1); };
  return uint32_t(at(p.y) * kSide + at(p.x));
}

// What one ray found: a direction and the irradiance for which it stands; open: no surface blocks it.
struct Explored {
  uint32_t cell = 0;
  float irradiance = 0;
  bool open = false;
};
using ExploredPoint = std::array<Explored, 2 * kSkyRays>;

Explored explore(const RenderInput& input, const SurfaceInteraction& si, const Vector3& wi, float weight) {
  const Ray ray = si.spawn(wi);
  Rgb Le(0);
  for (const uint32_t light : input.scene.infinite_lights)
    Le += escaped_radiance(input.scene.lights[light], ray);
  const float irradiance = weight * luminance(Le);
  if (!(irradiance > 0)) return {};
  return {cell_of(wi), irradiance, !input.bvh.occluded(ray)};
}

// Half of the rays are distributed by the cosine, which finds windows; half by the lights, which finds bright
// parts of the sky.
ExploredPoint explore(const RenderInput& input, const VisiblePoint& x, Sampler& sampler) {
  ExploredPoint rays;
  const Frame frame = Frame::from_z(x.query.n);
  for (int i = 0; i < kSkyRays; ++i) {
    const Point2 u = sampler.next_2d();
    const Point2 stratified((float(i % 4) + u.x) / 4, (float(i / 4) + u.y) / 4);
    const Vector3 by_cosine = frame.to_world(sample_cosine_hemisphere(stratified));
    rays[2 * i] = explore(input, x.si, by_cosine, kPi);
    const auto& lights = input.scene.infinite_lights;
    const auto s = sample_Li(input.scene.lights[lights[i % lights.size()]],
                             LightReceiver{x.query.p, x.query.n, false}, sampler.next_2d());
    const float cosine = s ? glm::dot(s->wi, x.query.n) : 0;
    if (s && s->pdf > 0 && cosine > 0) rays[2 * i + 1] = explore(input, x.si, s->wi, cosine / s->pdf);
  }
  return rays;
}

// Sums of a cell of space.
struct OpenSky {
  std::array<double, kSide * kSide> irradiance{};
  uint32_t open = 0;
};

}  // namespace

SkyGuide::SkyGuide(const RenderInput& input) {
  const std::vector<VisiblePoint> points = visible_points(input, pilot_count(input));
  std::vector<ExploredPoint> explored(points.size());
  parallel::for_index(size_t{0}, points.size(), [&](size_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kSkyStream), i);
    explored[i] = explore(input, points[i], sampler);
  });
  double open = 0, all = 0;
  for (const ExploredPoint& rays : explored)
    for (const Explored& ray : rays) {
      all += double(ray.irradiance);
      if (ray.open) open += double(ray.irradiance);
    }
  // Where a good part of the light arrives, samples by the lights' own densities are as good, and cheaper;
  // where none does, nothing helps.
  useful_ = open > 0 && open < kLittle * all;
  if (!useful_) return;
  for (size_t grid = 0; grid < kResolution.size(); ++grid) {
    grids_[grid] = {points, kResolution[grid]};
    std::map<uint64_t, OpenSky> sums;
    for (size_t i = 0; i < points.size(); ++i) {
      OpenSky& sum = sums[grids_[grid].key(points[i].query.p, points[i].query.n)];
      for (const Explored& ray : explored[i]) {
        if (!ray.open) continue;
        sum.irradiance[ray.cell] += double(ray.irradiance);
        ++sum.open;
      }
    }
    for (const auto& [key, sum] : sums)
      if (sum.open >= kEnough)
        cells_[grid].emplace(key, std::vector<double>(sum.irradiance.begin(), sum.irradiance.end()));
  }
}

SkyGuide::Directions SkyGuide::at(const Point3& p, const Normal3& n) const {
  for (size_t grid = 0; grid < grids_.size(); ++grid) {
    const auto found = cells_[grid].find(grids_[grid].key(p, n));
    if (found != cells_[grid].end()) return Directions(&found->second);
  }
  return {};
}

SkyGuide::Sample SkyGuide::Directions::sample(const Point2& u) const {
  const DiscreteDistribution::Sample cell = cells_->sample(u.x);
  const Point2 at((float(cell.index % kSide) + cell.u_remapped) / kSide,
                  (float(cell.index / kSide) + u.y) / kSide);
  const Vector3 wi = equal_area_square_to_sphere(at);
  return {wi, pdf(wi)};
}

float SkyGuide::Directions::pdf(const Vector3& wi) const {
  return cells_ ? cells_->pdf(cell_of(wi)) * kCellsPerSteradian : 0;
}

}  // namespace kaustik::render
