// Traces, shades and adds the samples of one block, as many at a time as fit into a packet.

#include "render/tiles/block_samples.h"

#include "render/estimators/photon_integrator.h"

namespace kaustik::render {

namespace {

bool valid(const Rgb& c, bool signed_light) {
  return is_finite(c) && (signed_light || (c.x >= 0 && c.y >= 0 && c.z >= 0));
}

// Estimators that subtract may give negative radiance, and are unbiased only if negative values are kept.
// So do spectral colours, which lie outside the gamut of RGB.
bool valid_radiance(const PixelResult& s, DirectEstimator direct, bool dispersion) {
  const bool predicted = direct == DirectEstimator::kPredicted || dispersion;
  return valid(s.emitted, dispersion) && valid(s.direct, predicted || direct == DirectEstimator::kSigned) &&
         valid(s.caustic, dispersion) && valid(s.indirect, predicted) && is_finite(s.bias);
}

void expose(const Sensor& sensor, PixelResult* s) {
  if (sensor.neutral) return;
  for (Rgb* light : {&s->emitted, &s->direct, &s->caustic, &s->indirect, &s->bias, &s->denoising_emitted,
                     &s->media_direct, &s->media_caustic, &s->media_indirect})
    *light = sensor(*light);
}

// Samples of the pixels of one block of rays, pixel by pixel, since neighbouring pixels see much the same
// photons.
class BlockSamples {
 public:
  BlockSamples(const RenderContext& ctx, const PixelRange& pixels, const SampleRange& samples)
      : ctx_(ctx), pixels_(pixels), samples_(samples) {
    rays_.trace(ctx.bvh, ctx.settings.seed, pixels.x0, pixels.y0, samples.part, samples.first,
                samples.end - samples.first);
    if (ctx.scene.needs.dispersion) dispersed_.resize(taken_.size());
  }

  void shade(photon::EstimateBatch* batch, TileCounters& counters) {
    for_each([&](int x, int y, uint64_t i, Sample& sample) {
      static_assert(kRayBlock * kRayBlock <= photon::EstimateBatch::kPixels);
      batch->begin_pixel(pixel_of_block(x, y));
      const uint64_t stream = pixel_stream(ctx_.settings.seed, ctx_.scene.camera, x, y);
      Sampler sampler(stream, i, ray_dimensions(ctx_.scene.camera));
      // Once per pixel and pass: most of the estimate's noise is that of the photons, which all samples
      // share.
      const bool with_bias = ctx_.settings.estimate_bias.value_or(false) && i == ctx_.samples.first;
      const CameraSample ray{rays_.ray(x, y, i), rays_.hit(x, y, i),  with_bias, batch,
                             samples_.light,     dispersed_of(sample)};
      const auto gathers = [&] { return counters.gather.queries + batch->gathers(); };
      const uint64_t rays_before = counters.rays.all(), gathers_before = gathers();
      trace_camera_ray(ctx_, ray, sampler, counters, &sample.result);
      sample.rays = counters.rays.all() - rays_before, sample.gathers = gathers() - gathers_before;
    });
    batch->flush(counters.gather);
    if (dispersed_.empty()) return;
    for_each([&](int, int, uint64_t, Sample& sample) { dispersed_of(sample)->add_to(&sample.result); });
  }

  void add_to(const BlockSums& sums) {
    for_each([&](int x, int y, uint64_t i, Sample& sample) {
      PixelResult& result = sample.result;
      if (valid_radiance(result, ctx_.plan.direct, ctx_.scene.needs.dispersion)) {
        expose(ctx_.scene.sensor, &result);
        const int weight = rays_.weight(x, y, i);
        add_to(sums.film, x - sums.film->sums.x0(), y - sums.film->sums.y0(), i, result, weight);
        if (sums.moments) add_to(&(*sums.moments)[pixel_of_block(x, y)], sample);
        return;
      }
      ++sums.tile->dropped;
      add_examples({{y, x, i}}, &sums.tile->examples);
    });
  }

 private:
  struct Sample {
    PixelResult result;
    uint64_t rays = 0, gathers = 0;  // cost: rays traced, gathers from a map
  };

  // Null if the scene does not need dispersion.
  DispersedLight* dispersed_of(const Sample& sample) {
    return dispersed_.empty() ? nullptr : &dispersed_[static_cast<size_t>(&sample - taken_.data())];
  }

  // Adds sample i of pixel (x, y) of the window.
  void add_to(PassFilm* film, int x, int y, uint64_t i, const PixelResult& result, int weight) const {
    film->sums.at(x, y).add(result, weight, samples_.light);
    if (film->halved() && in_half(i, ctx_.samples.end - ctx_.samples.first))
      film->half.at(x, y).add(result, weight, samples_.light);
    if (film->has_media()) film->media.at(x, y).add(result, weight);
  }

  // Traced light (kTraced) is what shadow rays and emission contribute. Its variance is reported as zero
  // where it cannot be separated from what the maps contribute, or where weights may cancel.
  void add_to(SampleMoments* moments, const Sample& sample) const {
    const bool apart = samples_lights(ctx_.plan.direct) && !ctx_.scene.camera.filter.is_negative();
    const Rgb traced = apart ? sample.result.emitted + sample.result.direct : Rgb(0);
    moments->light[size_t(SampleLight::kAll)].add(sample.result.radiance(), sample.rays + sample.gathers);
    moments->light[size_t(SampleLight::kTraced)].add(traced, sample.rays);
    ++moments->count;
  }

  template <class Fn>
  void for_each(const Fn& fn) {
    Sample* sample = taken_.data();
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x)
        if (has_pixel(samples_.part, x, y))
          for (uint64_t i = samples_.first; i < samples_.end; ++i) fn(x, y, i, *sample++);
  }

  const RenderContext& ctx_;
  PixelRange pixels_;
  SampleRange samples_;
  CameraRays rays_;
  std::array<Sample, accel::kRayLanes> taken_;
  std::vector<DispersedLight> dispersed_;  // of taken_; empty if the scene does not need dispersion
};

}  // namespace

bool render_block(const RenderContext& ctx, const PixelRange& pixels, const SampleRange& samples,
                  photon::EstimateBatch* batch, const BlockSums& sums, const std::function<bool()>& go_on) {
  const uint64_t most = CameraRays::most_samples(samples.part);
  for (uint64_t first = samples.first; first < samples.end; first += most) {
    BlockSamples some(ctx, pixels, {samples.part, first, std::min(samples.end, first + most), samples.light});
    some.shade(batch, sums.tile->counters);
    some.add_to(sums);
    if (!go_on()) return false;
  }
  return true;
}

}  // namespace kaustik::render
