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

#include "photon/shoot/guide_shoot.h"
#include "render/explore/visible_density.h"
#include "render/maps/disc_error.h"
#include "render/maps/pilot_photons.h"

namespace kaustik::render {

namespace {

using photon::Photon;
using photon::PhotonKind;

// Separates the random numbers of these photons from all others.
constexpr uint64_t kPilotPass = 0x73706c6974000000;
constexpr uint64_t kPilotPhotons = 1u << 16;
// Fewer indirect photons at visible points say little: guided ones are shot then.
constexpr int64_t kFewestSeen = 1 << 12;
// A map of as many photons for each that is shot is starved where they bring so much of the light.
constexpr int64_t kStarved = 1 << 8;
constexpr double kMuchLight = 0.02;
// The error of a disc is common to the pixels that it covers, while the noise of samples averages out over as
// many pixels where the picture is filtered or looked at from afar.
constexpr double kPixels = 64;
// Light is divided only where error times time are at most this multiple of those of the better of photons
// and paths alone.
constexpr double kWorthBoth = 0.5;

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

// Radiance of the source of a photon that meets specular surfaces first: the light where it emits the photon,
// or a glossy surface.
float radiance_of_source(const RenderInput& input, const photon::TraceSettings& trace,
                         const PilotPhotons& pilot, const photon::SourceSplit& sources, uint32_t index) {
  if (!std::isnan(pilot.glossy_radiance[index])) return pilot.glossy_radiance[index];
  const Sampler numbers(photon::photon_stream(trace), index);
  const photon::EmissionNumbers n = photon::numbers_of(photon::start_of(input.scene, numbers, trace.guide).u);
  const auto start = photon::emit_photon(input.scene, n, trace.photons, trace.emission);
  if (!start) return 0;
  const uint32_t light = photon::light_of_photon(input.scene, n.light).light;
  return sources.radiance_of_light(light, {start->ray.o, -start->ray.d});
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
      radiance = double(radiance_of_source(input, trace, pilot, split, l.index)), index = l.index;
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

// Share of the indirect photons that are left, of those that the sources would send if photons carried all.
double stored_share(const std::vector<SourceOfLight>& sources, const photon::SourceSplit& split) {
  double stored = 0, all = 0;
  for (const SourceOfLight& s : sources)
    if (s.indirect) ++all, stored += double(split.share_of(float(s.radiance)));
  return all > 0 ? stored / all : 1;
}

// Predicted squared errors of the light that photons and paths may divide.
struct Errors {
  double of_paths = 0, of_photons = 0, of_both = 0;
};

// all: squared error of discs if photons carried all light, b: with the shares that they have.
Errors predicted_errors(const std::vector<SourceOfLight>& sources, double samples, double all, double b) {
  Errors errors;
  for (const SourceOfLight& s : sources) {
    const double a = s.contrast / samples;
    const bool only_photons = std::isinf(a);
    errors.of_photons += s.share * all;
    errors.of_paths += s.share * (only_photons ? b : a);
    errors.of_both += s.share * (only_photons ? b : a * b / (a + b));
  }
  return errors;
}

// Divides the light so that the error is least. Where fewer photons are left, discs are wider and photons are
// worth less, so a few steps are taken towards the balance.
Errors balance(const std::vector<SourceOfLight>& sources, const DiscError& discs, double samples,
               double typical, photon::SourceSplit* split) {
  constexpr int kSteps = 4;
  const double all = discs.of(1);
  double b = all;
  for (int i = 0; i < kSteps; ++i) {
    split->set_balance(float(b * samples * typical));
    b = discs.of(stored_share(sources, *split));
  }
  return predicted_errors(sources, samples, all, b);
}

// The time that samples and photons take, as multiples of that of the samples' paths.
struct Costs {
  double gathers = 0, photons = 0;
};

// rays: of a photon. Who asks for a number of photons wants to pay for them.
Costs costs_of(const RenderInput& input, double rays) {
  // Measured in furnished rooms: a sample's gathers take one and a half to four times as long as its path of
  // some eight rays; photons travel in packets.
  constexpr double kGathers = 2, kRaysOfPath = 8, kPhotonRay = 1.0 / 3;
  if (input.settings.balance == Balance::kOff) return {kGathers, 0};
  const Camera& camera = input.scene.camera;
  const double samples = double(camera.width) * double(camera.height) * double(input.settings.spp);
  return {kGathers, kPhotonRay * rays * double(input.settings.photons) / (kRaysOfPath * samples)};
}

// Gives all light to photons or to paths where dividing it is not worth the time of both. needed: photons
// carry light that paths do not find. starved: photons tell too little. Returns the squared error of the
// choice.
double choose_balance(const Errors& errors, const Costs& costs, bool needed, bool starved,
                      photon::SourceSplit* split) {
  const double by_photons = costs.gathers + costs.photons;
  const double of_paths = errors.of_paths * (needed ? 1 + by_photons : 1);
  const double of_photons = errors.of_photons * by_photons, of_both = errors.of_both * (1 + by_photons);
  if (!starved && of_both <= kWorthBoth * std::min(of_paths, of_photons)) return errors.of_both;
  const bool paths = starved || of_paths < of_photons;
  split->set_balance(paths ? kInfinity : 0);
  return paths ? errors.of_paths : errors.of_photons;
}

double indirect_share(const std::vector<SourceOfLight>& sources) {
  double share = 0;
  for (const SourceOfLight& s : sources) share += s.indirect ? s.share : 0;
  return share;
}

// Whether photons carry light that paths do not find.
bool beyond_paths(const std::vector<SourceOfLight>& sources) {
  return std::ranges::any_of(sources, [](const SourceOfLight& s) { return std::isinf(s.contrast); });
}

// Squared noise of what paths bring.
double noise_of_paths(const std::vector<SourceOfLight>& sources, const photon::SourceSplit& split,
                      double samples) {
  double noise = 0;
  for (const SourceOfLight& s : sources) {
    const double w = double(split.share_of(float(s.radiance)));
    if (w < 1) noise += s.share * (1 - w) * (1 - w) * s.contrast / samples;
  }
  return noise;
}

LearnedSplit learned_from(const RenderInput& input, const std::vector<SourceOfLight>& sources, double samples,
                          double error, photon::SourceSplit&& split) {
  LearnedSplit learned{.sources = std::move(split), .error = error};
  learned.stored = stored_share(sources, learned.sources);
  learned.noise = noise_of_paths(sources, learned.sources, samples);
  learned.light = std::ranges::any_of(
      sources, [&](const SourceOfLight& s) { return learned.sources.share_of(float(s.radiance)) > 0; });
  // Photons may meet small mirrors and glass later.
  const bool may_meet = input.scene.needs.specular && std::ranges::any_of(input.scene.lights, is_delta);
  learned.photons = learned.light || may_meet;
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
  const double each = double(input.settings.photons) / double(kPilotPhotons);
  const DiscError discs(input, points, photon::IrradianceTree(indirect, bounds),
                        each * double(indirect.size()), each);
  photon::SourceSplit split(input.scene, firsts, 0);
  const std::vector<SourceOfLight> sources =
      sources_of(input, trace, pilot, visible, light, double(kPi) * typical / 2, split);
  const double samples = kPixels * double(input.settings.spp);
  const Errors errors = balance(sources, discs, samples, typical, &split);
  const Costs costs = costs_of(input, double(pilot.counters.rays) / double(kPilotPhotons));
  const bool starved = seen < kStarved && indirect_share(sources) > kMuchLight;
  const double error = choose_balance(errors, costs, beyond_paths(sources), starved, &split);
  return std::make_unique<const LearnedSplit>(learned_from(
      input, sources, samples, errors.of_paths > 0 ? error / errors.of_paths : 1, std::move(split)));
}

}  // namespace kaustik::render
