// Divides the photons of a pass among shoots, and learns what guides them.

#include "render/maps/photon_shoots.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel/work_span.h"
#include "render/explore/pilot_beams.h"
#include "render/explore/visible_density.h"
#include "render/maps/learn_split.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

// Caustic photons that uniform emission leaves on its way to other kinds cost nothing. If their share is at
// least this, guided ones are not worth their rays (docs/decisions/010-guided-photons.md).
constexpr double kEnoughCaustics = 1.0 / 64;

// Places in media have no side.
constexpr Normal3 kNoNormal{0, 0, 1};

// Points of camera rays in media that scatter light, as many as there are visible points.
std::vector<VisiblePoint> points_in_media(const RenderInput& input) {
  constexpr uint32_t kBeams = 1u << 11, kOnBeam = 8;
  const float most = 2 * input.scene.bounds.radius();
  std::vector<VisiblePoint> points;
  for (const Beam& beam : pilot_beams(input, kBeams))
    for (uint32_t i = 0; i < kOnBeam; ++i) {
      const float t = (float(i) + 0.5f) / float(kOnBeam) * std::min(beam.distance, most);
      points.push_back({{beam.ray.at(t), kNoNormal}});
    }
  return points;
}

// Learns a guide for one kind, which depends on scene and settings alone. Indirect photons lie wherever there
// is light, even outside a room, so those near visible points count most.
std::unique_ptr<const photon::LearnedGuide> learn_guide(const RenderInput& input, PhotonKind kind,
                                                        const photon::SourceSplit* split,
                                                        bool beside_others) {
  constexpr uint32_t kPoints = 1u << 14;
  const RenderSettings& s = input.settings;
  photon::GuideSettings guide{s.seed, s.photons, s.max_bounces, s.emission, kind};
  guide.under_glossy = input.plan.glossy_tails;
  guide.split = split;
  guide.split_caustics = input.plan.caustics == CausticEstimator::kSplit;
  if (beside_others) guide.enough = kEnoughCaustics;
  std::optional<VisibleDensity> visible, in_media;
  if (kind == PhotonKind::kIndirect) {
    visible.emplace(visible_points(input, kPoints));
    if (input.plan.medium_indirect) in_media.emplace(points_in_media(input));
    guide.importance = [&](PhotonKind left, const photon::Photon& photon) {
      return left == PhotonKind::kIndirect ? visible->at(photon) : in_media->at(photon.p, kNoNormal);
    };
  }
  return std::make_unique<const photon::LearnedGuide>(photon::learn_guide(input.scene, input.bvh, guide));
}

// One call of the tracer, for some of the kinds.
struct Shoot {
  photon::TraceSettings trace;
  bool guided = false;
  bool again = false;  // its photons start as those of the shoot before, so that their energy is not counted
};

// Moves a kind from one shoot to another.
void take(PhotonKind kind, Shoot* from, Shoot* to) {
  to->trace.kinds[kind] = std::exchange(from->trace.kinds[kind], false);
}

// The kind that the same paths leave in media.
PhotonKind in_medium(PhotonKind kind) {
  return kind == PhotonKind::kCaustic ? PhotonKind::kMediumCaustic : PhotonKind::kMediumIndirect;
}

uint64_t multiple(double of, uint64_t photons) {
  return std::max<uint64_t>(1, uint64_t(std::llround(of * double(photons))));
}

// The paths of caustics and of indirect light are shot together unless one of them needs far more.
void set_counts(const PhotonCounts& counts, std::vector<Shoot>* shoots, Shoot* others) {
  constexpr double kFarMore = 1.5;
  const uint64_t photons = others->trace.photons;
  for (Shoot& shoot : *shoots)
    shoot.trace.photons = multiple(shoot.trace.kinds.caustic ? counts.caustic : counts.indirect, photons);
  photon::KindMask& kinds = others->trace.kinds;
  if (kinds.caustic && kinds.indirect && counts.indirect > kFarMore * counts.caustic) {
    Shoot caustics = *others;
    caustics.trace.kinds = {};
    caustics.again = true;
    take(PhotonKind::kCaustic, others, &caustics);
    caustics.trace.photons = multiple(counts.caustic, photons);
    shoots->insert(shoots->begin(), caustics);
  }
  others->trace.photons =
      multiple(std::max(kinds.caustic ? counts.caustic : 0, kinds.indirect ? counts.indirect : 0), photons);
}

// One shoot for each guided kind, and one for all others.
std::vector<Shoot> plan_shoots(const RenderInput& input, const PassShare& pass, const PhotonGuides& guides) {
  Shoot others{trace_settings(input.settings, input.plan, pass)};
  others.trace.photons_on_segments = std::max(1u, guides.photons_on_segments);
  others.trace.split = guides.split ? &guides.split->sources : nullptr;
  others.trace.split_caustics = input.plan.caustics == CausticEstimator::kSplit;
  others.trace.split_indirect = input.plan.indirect == IndirectEstimator::kSplit;
  if (guides.split && !guides.split->photons) {
    if (others.trace.split_indirect) others.trace.kinds.indirect = false;
    if (others.trace.split_caustics) others.trace.kinds.caustic = false;
  }
  std::vector<Shoot> shoots;
  const auto guide = [&](PhotonKind kind, const auto& learned, uint64_t photons) {
    if (!others.trace.kinds[kind] || !learned || learned->guide.empty()) return;
    Shoot guided{others.trace, true};
    guided.trace.kinds = {};
    guided.trace.guide = &learned->guide;
    guided.trace.photons = photons;
    take(kind, &others, &guided);
    take(in_medium(kind), &others, &guided);
    shoots.push_back(guided);
  };
  guide(PhotonKind::kIndirect, guides.indirect, pass.photons);
  guide(PhotonKind::kCaustic, guides.caustic, guided_photons(input.settings, input.plan, pass.photons));
  if (guides.counts) set_counts(*guides.counts, &shoots, &others);
  if (others.trace.kinds.any()) shoots.insert(shoots.begin(), others);
  return shoots;
}

void add(const Shoot& shoot, photon::ShootResult&& result, photon::ShootResult* all,
         RenderStatistics* statistics) {
  photon::TraceCounters& c = result.counters;
  if (shoot.again) c.energy = {};
  if (shoot.guided)
    statistics->guided += {c.emitted, c.rays, c.dropped_invalid, c.stored};
  else
    statistics->photons += c;
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    if (shoot.trace.kinds[PhotonKind(k)]) all->buffers[k] = std::move(result.buffers[k]);
}

}  // namespace

photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass) {
  photon::TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = pass.pass;
  trace.photons = pass.photons;
  trace.max_bounces = settings.max_bounces;
  trace.emission = settings.emission;
  trace.kinds = kinds_needed(plan);
  trace.under_glossy = plan.glossy_tails;
  trace.shadow_behind_specular = plan.direct == DirectEstimator::kSigned;
  return trace;
}

uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons) {
  photon::KindMask kinds = kinds_needed(plan);
  if (!kinds.caustic || settings.guide == Guide::kOff) return 0;
  kinds.caustic = kinds.medium_caustic = false;
  return kinds.any() ? (photons + 1) / 2 : photons;
}

photon::GuidedPhotons may_be_guided(const RenderSettings& settings, const EstimatorPlan& plan,
                                    uint64_t photons) {
  return {guided_photons(settings, plan, photons),
          settings.guide == Guide::kOn && kinds_needed(plan).indirect};
}

void learn_sources(const RenderInput& input, PhotonGuides* guides) {
  const photon::KindMask kinds = kinds_needed(input.plan);
  const bool splits = splits_sources(input.plan);
  if (splits && !guides->split) guides->split = learn_split(input, nullptr);
  if (guides->split && !guides->split->photons) return;
  const bool guided = input.settings.guide == Guide::kOn && kinds.indirect;
  if (guided && !guides->indirect)
    guides->indirect = learn_guide(input, PhotonKind::kIndirect, nullptr, false);
  const photon::EmissionGuide none;
  if (splits && !guides->split)
    guides->split = learn_split(input, guides->indirect ? &guides->indirect->guide : &none);
}

namespace {

// Beside direct and shadow photons, and where photons lie in media, all kinds keep the number of the
// settings.
bool balances(const RenderInput& input) {
  const photon::KindMask kinds = kinds_needed(input.plan);
  return input.settings.balance == Balance::kOn && !kinds.direct && !kinds.shadow && !kinds.medium_caustic &&
         !kinds.medium_indirect;
}

void learn_counts(const RenderInput& input, PhotonGuides* guides) {
  if (guides->counts || !balances(input)) return;
  constexpr uint32_t kSeen = 1u << 14;
  const std::vector<VisiblePoint> seen = visible_points(input, kSeen);
  PhotonNeed caustic, indirect;
  bool together = false;
  const PassShare any = pass_share(0, 1, input.settings.photons, input.settings.spp);
  for (const Shoot& shoot : plan_shoots(input, any, *guides)) {
    const photon::KindMask& kinds = shoot.trace.kinds;
    together |= kinds.caustic && kinds.indirect;
    if (kinds.caustic) caustic = photons_needed(input, seen, shoot.trace, PhotonKind::kCaustic);
    if (kinds.indirect) indirect = photons_needed(input, seen, shoot.trace, PhotonKind::kIndirect);
  }
  guides->counts = within_limits(caustic, indirect, together);
}

}  // namespace

void learn_guides(const RenderInput& input, PhotonGuides* guides, RenderStatistics* statistics) {
  const PhaseWatch watch;
  learn_sources(input, guides);
  const photon::KindMask kinds = kinds_needed(input.plan);
  const bool only_paths =
      input.plan.caustics == CausticEstimator::kSplit && guides->split && !guides->split->photons;
  if (input.settings.guide == Guide::kOn && kinds.caustic && !only_paths && !guides->caustic) {
    const bool uniform_indirect = kinds.indirect && (!guides->indirect || guides->indirect->guide.empty());
    const bool beside_others = uniform_indirect || kinds.direct || kinds.shadow;
    const photon::SourceSplit* split = guides->split ? &guides->split->sources : nullptr;
    guides->caustic = learn_guide(input, PhotonKind::kCaustic, split, beside_others);
  }
  learn_counts(input, guides);
  statistics->guide_photons = statistics->guide_hits = statistics->guide_boxes = 0;
  for (const auto* guide : {guides->indirect.get(), guides->caustic.get()}) {
    if (!guide) continue;
    statistics->guide_photons += guide->emitted;
    statistics->guide_hits += guide->hits;
    statistics->guide_boxes += guide->guide.boxes();
  }
  statistics->photon_trace_s += watch.end("photon_trace");
}

void learn_segments(const RenderInput& input, PhotonGuides* guides, RenderStatistics* statistics) {
  if (!kinds_needed(input.plan).medium_caustic || guides->photons_on_segments > 0) return;
  constexpr uint64_t kFew = 1u << 14;
  const PhaseWatch watch;
  const uint64_t photons = std::min(input.settings.photons, kFew);
  const PassShare few = pass_share(0, 1, photons, input.settings.spp);
  for (const Shoot& shoot : plan_shoots(input, few, *guides)) {
    if (!shoot.trace.kinds.medium_caustic) continue;
    const auto stored = photon::shoot(input.scene, input.bvh, shoot.trace).counters.stored;
    guides->photons_on_segments =
        photon::photons_on_segments(photons, stored[size_t(PhotonKind::kMediumCaustic)]);
  }
  statistics->photon_trace_s += watch.end("photon_trace");
}

bool shoot_kinds(const RenderInput& input, const PassShare& pass, const PhotonGuides& guides,
                 const ProgressCallback& progress, photon::ShootResult* shot, RenderStatistics* statistics) {
  const PhaseWatch watch;
  const std::vector<Shoot> shoots = plan_shoots(input, pass, guides);
  uint64_t total = 0, before = 0;
  for (const Shoot& shoot : shoots) total += shoot.trace.photons;
  std::atomic<bool> cancelled{false};
  for (const Shoot& shoot : shoots) {
    const auto told = [&](uint64_t done, uint64_t) {
      const bool go_on = !progress || progress({"photons", before + done, total, pass.pass, pass.shares});
      if (!go_on) cancelled = true;
      return go_on;
    };
    add(shoot, photon::shoot(input.scene, input.bvh, shoot.trace, told), shot, statistics);
    if (cancelled) break;
    before += shoot.trace.photons;
  }
  statistics->photon_trace_s += watch.end("photon_trace");
  return !cancelled;
}

}  // namespace kaustik::render
