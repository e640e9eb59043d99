#pragma once
// Stochastic progressive photon mapping (Hachisuka and Jensen 2009) without refinements: the rival of the
// benchmarks. The code is our own, after the design of pbrt-v3's and pbrt-v4's SPPMIntegrator (Pharr et al.
// 2016, section 16.2). Each iteration finds a visible point per pixel, with direct light by one light sample;
// puts the points into a hash grid of linked lists; and traces photons one by one, uniformly from the lights
// by power, which add to the points in reach by atomics. Each pixel has its own radius, N and tau. Scene,
// lights, BSDFs, BVH and random numbers (Owen-scrambled Sobol, where pbrt has Halton) are this renderer's, so
// that only the design differs.
//
// Differences from pbrt: photons of lists that share a bucket count once; no photon is deposited on purely
// specular surfaces; glossy lobes that are followed get light from lights that they meet, without a light
// sample. Not handled: surfaces with both diffuse and specular lobes (the specular ones are left out),
// negative pixel filters, footprints of textures. Atomic sums depend on the order of threads.

#include <chrono>

#include "accel/bvh.h"
#include "benchmarks/sppm_rival/point_grid.h"
#include "core/sampling/warp.h"
#include "photon/emission/emission.h"
#include "photon/trace/shading_correction.h"
#include "render/camera/camera_rays.h"
#include "render/estimators/lighting.h"
#include "render/picture/image.h"

namespace kaustik::benchmarks::sppm {

struct Settings {
  uint32_t iterations = 16;
  uint64_t photons = 262144;  // per iteration
  float radius = 0.025f;      // in the first iteration, metres
  int max_bounces = 16;       // longest chain of reflections and refractions from the light, or from the eye
  uint64_t seed = 0;
};

// Wall seconds of the parts, summed over all iterations.
struct Seconds {
  double camera = 0, grid = 0, photons = 0, update = 0;
};

class Renderer {
 public:
  Renderer(const Scene& scene, const accel::Bvh& bvh, const Settings& settings)
      : scene_(scene), bvh_(bvh), settings_(settings), rays_(scene.camera) {
    pixels_ = std::make_unique<Pixel[]>(count());
    for (uint32_t i = 0; i < count(); ++i) pixels_[i].radius = settings.radius;
    direct_.method = render::Method::kMc;
  }

  // Runs all iterations. Call it once.
  render::Image render() {
    for (uint32_t i = 0; i < settings_.iterations; ++i) iterate(i);
    render::Image image(scene_.camera.width, scene_.camera.height);
    for (uint32_t i = 0; i < count(); ++i)
      image.pixels[i] = scene_.sensor(radiance(pixels_[i], settings_.iterations));
    return image;
  }

  const Seconds& seconds() const { return seconds_; }

 private:
  uint32_t count() const { return uint32_t(scene_.camera.width) * uint32_t(scene_.camera.height); }

  void iterate(uint32_t iteration) {
    timed(&seconds_.camera,
          [&] { for_all(count(), 1024, [&](uint64_t i) { look(uint32_t(i), iteration); }); });
    timed(&seconds_.grid, [&] { grid_.build(pixels_.get(), count()); });
    timed(&seconds_.photons, [&] {
      const uint64_t first = iteration * settings_.photons;
      for_all(settings_.photons, 1024, [&](uint64_t i) { shoot(first + i); });
    });
    timed(&seconds_.update, [&] { for_all(count(), 4096, [&](uint64_t i) { update(pixels_[i]); }); });
  }

  template <class Fn>
  static void timed(double* seconds, const Fn& fn) {
    const auto start = std::chrono::steady_clock::now();
    fn();
    *seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  template <class Fn>
  static void for_all(uint64_t count, size_t grain, const Fn& fn) {
    tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count, grain), [&](const auto& range) {
      for (uint64_t i = range.begin(); i < range.end(); ++i) fn(i);
    });
  }

  Ray camera_ray(uint32_t i, Sampler& sampler) const {
    const Camera& camera = scene_.camera;
    const auto width = uint32_t(camera.width);
    const Point2 middle = Point2(i % width, i / width) + 0.5f;
    const Point2 raster = middle + camera.filter.sample(sampler.next_2d()).offset;
    if (camera.lens_radius() > 0)
      return rays_.through(raster, sample_uniform_disk_concentric(sampler.next_2d()));
    return rays_(raster);
  }

  // Follows the camera path of pixel i to its first diffuse surface.
  void look(uint32_t i, uint32_t iteration) {
    Pixel& pixel = pixels_[i];
    pixel.visible = false;
    Sampler sampler(
        render::pixel_stream(settings_.seed, scene_.camera, int(i % uint32_t(scene_.camera.width)),
                             int(i / uint32_t(scene_.camera.width))),
        iteration);
    Ray ray = camera_ray(i, sampler);
    Rgb beta(1);
    for (int events = 0; events <= settings_.max_bounces; ++events) {
      SurfaceInteraction si;
      if (!bvh_.intersect(ray, &si)) {
        pixel.Ld += beta * render::escaped(scene_, ray);
        return;
      }
      pixel.Ld += beta * render::emitted(scene_, si, -ray.d);
      const render::ShadingPoint& x = pixel.point.emplace(scene_, si, -ray.d);
      if (!x.specular()) return see(pixel, beta, sampler);
      const auto s = render::scatter(x, sampler);
      if (!s) return;
      beta *= s->weight;
      ray = si.spawn(s->wi);
    }
  }

  // Handles the end of the camera path, at pixel.point.
  void see(Pixel& pixel, const Rgb& beta, Sampler& sampler) {
    const render::RenderContext context{{scene_, bvh_, direct_, plan_}, maps_};
    render::TileCounters ignored;
    pixel.Ld +=
        beta * render::sample_direct(context, *pixel.point, render::LightWeight::kAlone, sampler, ignored);
    pixel.p = pixel.point->si.p;
    pixel.beta = beta;
    pixel.visible = true;
  }

  // Traces photon `index` of all iterations. It deposits nothing at its first surface, whose light is direct.
  void shoot(uint64_t index) {
    Sampler sampler(hash_combine(settings_.seed, kPhotonStream), index);
    const auto start = photon::emit_photon(scene_, photon::emission_numbers(scene_, sampler),
                                           settings_.photons, EmissionMode::kCosine);
    if (!start || (start->from_sky && bvh_.occluded({start->ray.o, -start->ray.d}))) return;
    Ray ray = start->ray;
    Rgb flux = start->flux;
    for (int events = 1; events <= settings_.max_bounces; ++events) {
      SurfaceInteraction si;
      if (!bvh_.intersect(ray, &si)) return;
      const BsdfAt bsdf(scene_, si, -ray.d);
      if (events > 1 && !is_specular(*bsdf)) deposit(si, -ray.d, flux);
      if (events == settings_.max_bounces || !bounce(si, *bsdf, sampler, &ray, &flux)) return;
    }
  }

  void deposit(const SurfaceInteraction& si, const Vector3& wi, const Rgb& flux) {
    const Rgb arriving = photon::detail::shading_correction(si, wi, glm::dot(wi, si.ns)) * flux;
    grid_.for_each(si.p, [&](Pixel& pixel) {
      const render::ShadingPoint& x = *pixel.point;
      const Vector3 local = x.frame.to_local(wi);
      if (!(glm::dot(wi, x.si.n) * local.z > 0)) return;
      const Rgb value = f(*x.bsdf, x.wo_local, local, LobePart::kDiffuse);
      if (!is_black(value)) pixel.add(value * arriving);
    });
  }

  // Samples the next direction and applies Russian roulette by the remaining flux; false when the photon is
  // absorbed.
  static bool bounce(const SurfaceInteraction& si, const Bsdf& bsdf, Sampler& sampler, Ray* ray, Rgb* flux) {
    const float uc = sampler.next_1d();
    const Point2 u = sampler.next_2d();
    const float survival = sampler.next_1d();
    const Frame frame = Frame::from_z(si.ns);
    const Vector3 wo = -ray->d, wo_local = frame.to_local(wo);
    const auto s = sample_f(bsdf, wo_local, uc, u, TransportMode::kImportance);
    if (!s) return false;
    const Vector3 wi = glm::normalize(frame.to_world(s->wi));
    const float c_in = photon::detail::shading_correction(si, wo, wo_local.z),
                c_out = photon::detail::shading_correction(si, wi, s->wi.z);
    if (c_out == 0) return false;
    const Rgb next = s->weight * (c_in / c_out) * *flux;
    const float q = std::min(1.0f, luminance(next) / luminance(*flux));
    if (!(survival < q)) return false;
    *flux = next / q;
    *ray = si.spawn(wi);
    return true;
  }

  static constexpr uint64_t kPhotonStream =
      0x5bb3;  // keeps the photons' random numbers apart from the image's

  const Scene& scene_;
  const accel::Bvh& bvh_;
  const Settings settings_;
  const RayGenerator rays_;
  // The settings of the light sample, without maps.
  render::RenderSettings direct_;
  render::EstimatorPlan plan_;
  render::PhotonMaps maps_;
  std::unique_ptr<Pixel[]> pixels_;
  PointGrid grid_;
  Seconds seconds_;
};

}  // namespace kaustik::benchmarks::sppm
