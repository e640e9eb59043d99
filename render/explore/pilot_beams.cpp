#include "render/explore/pilot_beams.h"

#include "accel/media_walk.h"
#include "core/parallel/parallel.h"
#include "core/sampling/sampler.h"
#include "photon/emission/emission.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from those of the image.
constexpr uint64_t kBeamStream = 0xBEA3;

// Follows a ray to its first surface with diffuse lobes and adds its parts in media that scatter.
void follow(const RenderInput& input, Ray ray, MediumIndex medium, Sampler& sampler,
            std::vector<Beam>* beams) {
  const Scene& scene = input.scene;
  for (int events = 0; events <= input.settings.max_bounces; ++events) {
    SurfaceInteraction si;
    const bool met = input.bvh.intersect(ray, &si);
    const float distance = met ? glm::distance(si.p, ray.o) : kInfinity;
    medium = accel::walk_media(input.bvh.interfaces(), ray, distance, medium,
                               [&](MediumIndex m, float begin, float end) {
                                 if (scene.media[m].scatters())
                                   beams->push_back({{ray.at(begin), ray.d}, end - begin, m});
                                 return true;
                               });
    if (!met) return;
    const ShadingPoint x(scene, si, -ray.d);
    if (!x.specular()) return;
    const auto s = scatter(x, sampler);
    if (!s) return;
    ray = si.spawn(s->wi);
    medium = medium_beyond(scene, si, x.wo, s->wi, medium);
  }
}

// What some camera may see: where a lamp shines.
void follow_from_lamp(const RenderInput& input, Sampler& sampler, std::vector<Beam>* beams) {
  const photon::EmissionNumbers u = photon::emission_numbers(input.scene, sampler);
  const auto start = photon::emit_photon(input.scene, u, 1, input.settings.emission);
  if (!start) return;
  const uint32_t light = photon::light_of_photon(input.scene, u.light).light;
  const MediumIndex medium = accel::medium_at_start(input.scene, input.bvh, light, start->ray);
  follow(input, start->ray, medium, sampler, beams);
}

void follow_from_view(const RenderInput& input, uint64_t index, uint64_t count, Sampler& sampler,
                      std::vector<Beam>* beams) {
  const Camera& camera =
      input.views.empty() ? input.scene.camera : input.views[index * input.views.size() / count];
  const Point2 u = sampler.next_2d();
  const Ray ray = camera.generate_ray({u.x * float(camera.width), u.y * float(camera.height)});
  follow(input, ray, input.scene.camera_medium, sampler, beams);
}

}  // namespace

std::vector<Beam> pilot_beams(const RenderInput& input, uint32_t count) {
  std::vector<std::vector<Beam>> found(count);
  parallel::for_index(uint32_t{0}, count, [&](uint32_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kBeamStream), i);
    if (input.settings.for_camera == ForCamera::kAll)
      follow_from_lamp(input, sampler, &found[i]);
    else
      follow_from_view(input, i, count, sampler, &found[i]);
  });
  std::vector<Beam> beams;
  for (const auto& of_one : found) beams.insert(beams.end(), of_one.begin(), of_one.end());
  return beams;
}

}  // namespace kaustik::render
