#include "photon/sources/source_split.h"

namespace kaustik::photon {

namespace {

// The mean radiance of an area light, the largest one of a portal: rays that leave through it tell the sky's
// radiance only where they do so. Those of skies that depend on the direction are not read.
float radiance_of(const Light& light) {
  if (is_delta(light)) return kInfinity;
  if (const auto* area = std::get_if<DiffuseAreaLight>(&light))
    return luminance(area->power()) / (kPi * area->area * (area->twosided ? 2 : 1));
  return float(brightness(light, 1));
}

}  // namespace

SourceSplit::SourceSplit(const Scene& scene, const std::vector<Photon>& firsts, float balance)
    : scene_(&scene), tree_(firsts, scene.bounds), balance_(balance) {
  for (const Light& light : scene.lights) radiance_.push_back(radiance_of(light));
}

float SourceSplit::radiance_of_surface(const Point3& p, const Normal3& n, bool both_sides) const {
  float E = tree_.at(p, n).irradiance();
  if (both_sides) E += tree_.at(p, -n).irradiance();
  return E / kPi;
}

float SourceSplit::radiance_of_light(uint32_t light, const Ray& to_light) const {
  const auto* sky = std::get_if<ImageInfiniteLight>(&scene_->lights[light]);
  return sky ? luminance(sky->Le(to_light)) : radiance_[light];
}

}  // namespace kaustik::photon
