// Balances the noise of paths against noise and bias of photons, source by source.
//
// A source of radiance L that gives a place of radiance Lx the share phi of its light is met by a path with
// the probability phi Lx / L, so the relative variance of a sample is phi a with a = L / Lx. Photons have the
// relative variance phi / n where n are in reach, and a bias. Both add up over the sources, so that the
// shares w of photons that minimise  sum of phi ((1 - w)^2 a + w^2 b)  are  w = a / (a + b).

#include "render/maps/learn_split.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "core/parallel/parallel.h"
#include "core/sampling/warp.h"
#include "photon/shoot/guide_shoot.h"
#include "render/explore/visible_density.h"
#include "render/maps/pilot_photons.h"
#include "render/maps/radius.h"

namespace kaustik::render {

namespace {

using photon::Photon;
using photon::PhotonKind;

// Separates the random numbers of these photons and rays from all others.
constexpr uint64_t kPilotPass = 0x73706c6974000000, kClearanceStream = 0xC1EA;
constexpr uint64_t kPilotPhotons = 1u << 16;
// Fewer indirect photons at visible points say little: guided ones are shot then.
constexpr int64_t kFewestSeen = 1 << 12;
// A map of as many photons for each that is shot is starved where they bring so much of the light.
constexpr int64_t kStarved = 1 << 8;
constexpr double kMuchLight = 0.02;
constexpr int kRaysEach = 16;
// The error of a disc is common to the pixels that it covers, while the noise of samples averages out over as
// many pixels where the picture is filtered or looked at from afar.
constexpr double kPixels = 64;
// Photons and paths are divided only where that leaves so much less of the squared error than the better of
// them alone: both take their time.
constexpr double kWorthBoth = 0.25;

photon::TraceSettings pilot_settings(const RenderInput& input, const photon::EmissionGuide* guide) {
  photon::TraceSettings trace;
  trace.seed = input.settings.seed;
  trace.pass = kPilotPass;
  trace.photons = kPilotPhotons;
  trace.max_bounces = input.settings.max_bounces;
  trace.emission = input.settings.emission;
  trace.guide = guide && !guide->empty() ? guide : nullptr;
  trace.kinds.direct = trace.kinds.caustic = trace.kinds.indirect = true;
  return trace;
}

// Radiance of the light where it emits the photon.
float radiance_of_start(const RenderInput& input, const photon::TraceSettings& trace,
                        const photon::SourceSplit& sources, uint32_t index) {
  const photon::EmissionNumbers n = photon::numbers_of(photon::start_of(input.scene, trace, index).u);
  const auto start = photon::emit_photon(input.scene, n, trace.photons, trace.emission);
  if (!start) return 0;
  const uint32_t light = photon::light_of_photon(input.scene, n.light).light;
  return sources.radiance_of_light(light, {start->ray.o, -start->ray.d});
}

// Harmonic mean of the distances to other surfaces, weighted by the cosine at x: the irradiance varies over
// distances of about that (Ward, Rubinstein and Clear 1988).
double clearance_at(const RenderInput& input, const VisiblePoint& x, Sampler& sampler) {
  const Frame frame = Frame::from_z(x.query.n);
  double inverse = 0;
  for (int i = 0; i < kRaysEach; ++i) {
    const Vector3 wi = frame.to_world(sample_cosine_hemisphere(sampler.next_2d()));
    if (!(glm::dot(wi, x.query.n) > 0)) continue;
    const Hit hit = input.bvh.intersect(x.si.spawn(wi));
    if (hit.valid() && hit.t > 0) inverse += 1 / double(hit.t);
  }
  return inverse > 0 ? kRaysEach / inverse : HUGE_VAL;
}

// Relative error of a disc of radius r at a place of clearance c. The second derivative of the irradiance is
// about 1 / (2 c)^2 of it, and the second-order term of its mean over the disc is r^2 / 8 times that:
// r^2 / (32 c^2). Where surfaces are so near that this says little, half of the light may be wrong.
double error_of_disc(double radius, double clearance) {
  constexpr double kMost = 0.5;
  const double ratio = radius / clearance;
  return std::min(ratio * ratio / 32, kMost);
}

// Mean squared error of discs with `reach` of `photons` photons, beside their noise.
double bias_of_discs(const RenderInput& input, const std::vector<VisiblePoint>& points,
                     const photon::IrradianceTree& pilot, double photons, double reach) {
  constexpr size_t kEach = 4;
  std::vector<double> squared((points.size() + kEach - 1) / kEach);
  parallel::for_index(size_t{0}, squared.size(), [&](size_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kClearanceStream), i);
    const VisiblePoint& x = points[kEach * i];
    const double density = photons / double(kPilotPhotons) * pilot.at(x.query.p, x.query.n).density();
    const double radius = density > 0 ? std::sqrt(reach / (double(kPi) * density)) : HUGE_VAL;
    const double error = error_of_disc(radius, clearance_at(input, x, sampler));
    squared[i] = std::isnan(error) ? 0 : error * error;
  });
  double sum = 0;
  for (const double s : squared) sum += s / double(squared.size());
  return sum;
}

// Median radiance of the points, were they white.
double typical_radiance(const std::vector<VisiblePoint>& points, const photon::IrradianceTree& light) {
  std::vector<float> found;
  for (const VisiblePoint& x : points) found.push_back(light.at(x.query.p, x.query.n).irradiance() / kPi);
  std::erase(found, 0.0f);
  if (found.empty()) return 0;
  const auto median = found.begin() + std::ptrdiff_t(found.size() / 2);
  std::ranges::nth_element(found, median);
  return double(*median);
}

// A share of the light of visible places, and the radiance of its source as a multiple of theirs.
struct SourceOfLight {
  double share = 0, contrast = 0;
  double radiance = 0;  // W/(m^2 sr)
  bool indirect = false;
};

std::vector<SourceOfLight> sources_of(const RenderInput& input, const photon::TraceSettings& trace,
                                      const PilotPhotons& pilot, const VisibleDensity& visible,
                                      const photon::IrradianceTree& light, double least,
                                      const photon::SourceSplit& split) {
  std::vector<SourceOfLight> sources;
  double all = 0;
  double radiance = 0;  // of the source of the present index
  uint32_t index = ~0u;
  for (const PilotPhotons::Left& l : pilot.left) {
    if (l.kind == PhotonKind::kCaustic)
      radiance = double(radiance_of_start(input, trace, split, l.index)), index = l.index;
    const double E = std::max(double(light.at(l.photon.p, l.photon.n).irradiance()), least);
    const double share = E > 0 ? double(visible.at(l.photon)) * double(luminance(l.photon.flux)) / E : 0;
    all += share;
    if (l.kind == PhotonKind::kDirect)
      radiance = double(split.radiance_of_surface(l.photon.p, l.photon.n, false)), index = l.index;
    else if (index == l.index)
      sources.push_back({share, radiance / (E / double(kPi)), radiance, l.kind == PhotonKind::kIndirect});
  }
  for (SourceOfLight& source : sources) source.share /= std::max(all, double(FLT_MIN));
  return sources;
}

// Predicted squared errors of the light that photons and paths may divide.
struct Errors {
  double of_paths = 0, of_photons = 0, of_both = 0;
};

Errors predicted_errors(const std::vector<SourceOfLight>& sources, double samples, double b) {
  Errors errors;
  for (const SourceOfLight& s : sources) {
    const double a = s.contrast / samples;
    const bool only_photons = std::isinf(a);
    errors.of_photons += s.share * b;
    errors.of_paths += s.share * (only_photons ? b : a);
    errors.of_both += s.share * (only_photons ? b : a * b / (a + b));
  }
  return errors;
}

// Gives all light to photons or to paths where dividing it is not worth the time of both. starved: photons
// tell too little. Returns the squared error of the choice.
double choose_balance(const Errors& errors, bool starved, photon::SourceSplit* split) {
  const double of_better = std::min(errors.of_paths, errors.of_photons);
  if (!starved && errors.of_both <= kWorthBoth * of_better) return errors.of_both;
  const bool paths = starved || errors.of_paths < errors.of_photons;
  split->set_balance(paths ? kInfinity : 0);
  return paths ? errors.of_paths : errors.of_photons;
}

LearnedSplit learned_from(const std::vector<SourceOfLight>& sources, photon::SourceSplit&& split) {
  LearnedSplit learned{.sources = std::move(split), .photons = false};
  double stored = 0, all = 0;
  for (const SourceOfLight& s : sources) {
    const float w = learned.sources.share_of(float(s.radiance));
    learned.photons |= w > 0;
    if (s.indirect) ++all, stored += double(w);
  }
  if (all > 0) learned.stored = stored / all;
  return learned;
}

}  // namespace

std::unique_ptr<const LearnedSplit> learn_split(const RenderInput& input,
                                                const photon::EmissionGuide* guide) {
  constexpr uint32_t kPoints = 1u << 14;
  const photon::TraceSettings trace = pilot_settings(input, guide);
  const PilotPhotons pilot = shoot_pilot(input, trace);
  const std::vector<VisiblePoint> points = visible_points(input, kPoints);
  const VisibleDensity visible(points);
  const std::vector<Photon> firsts = pilot.of([](PhotonKind kind) { return kind != PhotonKind::kIndirect; });
  const std::vector<Photon> indirect =
      pilot.of([](PhotonKind kind) { return kind == PhotonKind::kIndirect; });
  const auto seen = std::ranges::count_if(indirect, [&](const Photon& p) { return visible.at(p) > 0; });
  if (guide == nullptr && seen < kFewestSeen) return {};
  const Bounds3& bounds = input.scene.bounds;
  const photon::IrradianceTree light(pilot.of([](PhotonKind) { return true; }), bounds);
  const double typical = typical_radiance(points, light);
  const double photons = double(input.settings.photons);
  const double reach =
      photons_in_reach_of_indirect(photons / double(kPilotPhotons) * double(indirect.size()));
  const double bias = bias_of_discs(input, points, photon::IrradianceTree(indirect, bounds), photons, reach);
  const double b = 1 / reach + bias, samples = kPixels * double(input.settings.spp);
  photon::SourceSplit split(input.scene, firsts, float(b * samples * typical));
  const std::vector<SourceOfLight> sources =
      sources_of(input, trace, pilot, visible, light, double(kPi) * typical / 2, split);
  const Errors errors = predicted_errors(sources, samples, b);
  double of_indirect = 0;
  for (const SourceOfLight& s : sources) of_indirect += s.indirect ? s.share : 0;
  const double error = choose_balance(errors, seen < kStarved && of_indirect > kMuchLight, &split);
  LearnedSplit learned = learned_from(sources, std::move(split));
  if (errors.of_paths > 0) learned.error = error / errors.of_paths;
  // Photons may meet small mirrors and glass later.
  learned.photons |= input.scene.needs.specular && std::ranges::any_of(input.scene.lights, is_delta);
  return std::make_unique<const LearnedSplit>(std::move(learned));
}

}  // namespace kaustik::render
