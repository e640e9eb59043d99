#include "photon/guide_shoot.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "photon/shoot.h"

namespace kaustik::photon {

namespace {

// Keeps these photons apart from those of any pass that can be.
constexpr uint64_t kGuidePass = 0x6775696465640000;
constexpr uint64_t kRounds = 5, kMostRounds = 12;  // more where few photons have served yet
// A guide is of use where the variance falls to so much of it, by light that is not guided well, too.
constexpr double kMostVariance = 0.75;

// A start that served, and what its photon is worth: flux^2, were it the only one.
struct Start {
  EmissionPoint u{};
  double square = 0;
};

class GuideLearner {
 public:
  GuideLearner(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings)
      : scene_(scene), bvh_(bvh), settings_(settings) {}

  LearnedGuide learn() {
    LearnedGuide learned;
    for (uint64_t round = 0; round < kRounds || (round < kMostRounds && found_few()); ++round) {
      const TraceSettings trace = settings_of(round, learned.guide);
      shoot(trace);
      learned.emitted += trace.photons;
      if (trace.guide)
        guides_.push_back(std::move(learned.guide));
      else
        ++uniform_rounds_;
      learned.guide = EmissionGuide(weighted(), scene_.lights.size() > 1 ? 5 : 4);
    }
    learned.hits = starts_.size();
    if (learned.guide.variance() > kMostVariance) learned.guide = {};
    return learned;
  }

 private:
  // A small target is found step by step: each round knows it better, and meets it more often.
  bool found_few() const { return !starts_.empty() && starts_.size() < 2048; }

  TraceSettings settings_of(uint64_t round, const EmissionGuide& guide) const {
    constexpr uint64_t kFewest = 1u << 11, kMost = 1u << 15;
    TraceSettings trace;
    trace.seed = settings_.seed;
    trace.pass = kGuidePass + round;
    trace.photons = std::clamp(settings_.photons / (8 * kRounds), kFewest, kMost);
    trace.max_bounces = settings_.max_bounces;
    trace.emission = settings_.emission;
    trace.kinds.caustic = true;
    trace.guide = guide.empty() ? nullptr : &guide;
    return trace;
  }

  // Adds the starts of one round that served, by photon.
  void shoot(const TraceSettings& trace) {
    const uint64_t blocks = (trace.photons + kShootBlock - 1) / kShootBlock;
    std::vector<std::vector<Start>> of_block(blocks);
    tbb::parallel_for(uint64_t{0}, blocks, [&](uint64_t block) {
      TraceCounters ignored;
      const uint64_t first = block * kShootBlock, end = std::min(trace.photons, first + kShootBlock);
      const auto sink = [&](PhotonKind, const Photon& photon, uint64_t index) {
        of_block[block].push_back(start_of(trace, index, photon));
      };
      trace_photons(scene_, surfaces_, bvh_, trace, first, end, sink, ignored);
    });
    for (const auto& found : of_block) starts_.insert(starts_.end(), found.begin(), found.end());
  }

  Start start_of(const TraceSettings& trace, uint64_t index, const Photon& photon) const {
    Sampler sampler(photon_stream(trace), index);
    const EmissionNumbers n = emission_numbers(scene_, sampler);
    Start start{{n.position.x, n.position.y, n.direction.x, n.direction.y, n.lamp}};
    const double weight = trace.guide ? double(trace.guide->warp(start.u)) : 1;
    const double sum = double(photon.flux.x) + double(photon.flux.y) + double(photon.flux.z);
    const double flux = sum / weight * double(trace.photons);
    start.square = flux * flux;
    return start;
  }

  // The starts of all rounds, as of one density: the sum of the rounds' (the balance heuristic, Veach 1997).
  std::vector<GuideHit> weighted() const {
    std::vector<GuideHit> hits(starts_.size());
    tbb::parallel_for(size_t{0}, hits.size(), [&](size_t i) {
      double density = uniform_rounds_;
      for (const EmissionGuide& guide : guides_) density += double(guide.density(starts_[i].u));
      hits[i] = {starts_[i].u, starts_[i].square / density};
    });
    return hits;
  }

  const Scene& scene_;
  const accel::Bvh& bvh_;
  const GuideSettings& settings_;
  SurfaceTable surfaces_{scene_};
  double uniform_rounds_ = 0;
  std::vector<EmissionGuide> guides_;  // of the other rounds
  std::vector<Start> starts_;
};

}  // namespace

LearnedGuide learn_guide(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings) {
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return {};
  return GuideLearner(scene, bvh, settings).learn();
}

}  // namespace kaustik::photon
