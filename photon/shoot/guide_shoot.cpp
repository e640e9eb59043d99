// Learns an EmissionGuide in rounds, and decides when guiding is worthwhile.

#include "photon/shoot/guide_shoot.h"

#include <algorithm>

#include "core/parallel/parallel.h"
#include "photon/shoot/shoot.h"

namespace kaustik::photon {

namespace {

// Pass number that keeps these photons' random sequences apart from those of any real pass.
constexpr uint64_t kGuidePass = 0x6775696465640000;
// Further rounds, each twice as large, follow while few photons have been useful.
constexpr uint64_t kRounds = 5, kMostRounds = 12;
// A guide is used only if it reduces the variance, that of poorly guided light included, to this fraction.
constexpr double kMostVariance = 0.75;

// A start whose photons were useful. `square` is the sum of importance times flux^2 over them, as if it were
// the only start.
struct Start {
  EmissionPoint u{};
  double square = 0;
};

KindMask only(PhotonKind kind) {
  const bool caustic = kind == PhotonKind::kCaustic, indirect = kind == PhotonKind::kIndirect;
  return {.caustic = caustic, .indirect = indirect, .medium_caustic = caustic, .medium_indirect = indirect};
}

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
      rounds_.push_back({double(trace.photons), std::move(learned.guide)});
      learned.guide = EmissionGuide(weighted(), scene_.lights.size() > 1 ? 5 : 4);
      if (has_nothing_to_gain(learned.guide) || uniform_is_enough()) break;
    }
    learned.hits = starts_.size();
    if (learned.guide.variance() > kMostVariance || uniform_is_enough()) learned.guide = {};
    return learned;
  }

 private:
  // Nothing to gain: many photons were useful, and their starts are nearly uniform.
  bool has_nothing_to_gain(const EmissionGuide& guide) const {
    return starts_.size() >= (1u << 12) && guide.variance() > 0.9;
  }
  // The first, uniform round found so many useful photons that guiding is not needed.
  bool uniform_is_enough() const { return double(uniform_hits_) >= settings_.enough * rounds_[0].photons; }

  struct Round {
    double photons = 0;
    EmissionGuide guide;  // empty: uniform
  };

  // Whether more rounds are worthwhile. A small target is found step by step: each round knows it better and
  // hits it more often. Photons that miss it end soon, so they cost little.
  bool found_few() const {
    return !starts_.empty() && starts_.size() < (1u << 14) && rays_ < settings_.photons / 2;
  }

  TraceSettings settings_of(uint64_t round, const EmissionGuide& guide) const {
    constexpr uint64_t kFewest = 1u << 11, kMost = 1u << 15;
    TraceSettings trace;
    trace.seed = settings_.seed;
    trace.pass = kGuidePass + round + (uint64_t(settings_.kind) << 8);
    trace.photons = std::clamp(settings_.photons / 64, kFewest, kMost)
                    << (round < kRounds ? 0 : round - kRounds + 1);
    trace.max_bounces = settings_.max_bounces;
    trace.emission = settings_.emission;
    trace.under_glossy = settings_.under_glossy;
    trace.split = settings_.split;
    trace.split_caustics = settings_.split_caustics;
    trace.kinds = only(settings_.kind);
    trace.split_indirect = trace.of_paths = settings_.of_paths;
    if (settings_.of_paths) trace.kinds.caustic = true;
    trace.guide = guide.empty() ? nullptr : &guide;
    return trace;
  }

  // Traces one round and appends the starts whose photons were useful, in the order of photon indices.
  void shoot(const TraceSettings& trace) {
    const uint64_t blocks = (trace.photons + kLearnBlock - 1) / kLearnBlock;
    std::vector<std::vector<Start>> of_block(blocks);
    std::vector<TraceCounters> counters(blocks);
    parallel::for_index(uint64_t{0}, blocks, [&](uint64_t block) {
      const uint64_t first = block * kLearnBlock, end = std::min(trace.photons, first + kLearnBlock);
      std::vector<double> squares(end - first);
      const auto sink = [&](PhotonKind kind, const Photon& photon, uint64_t index) {
        const double flux = double(photon.flux.x) + double(photon.flux.y) + double(photon.flux.z);
        squares[index - first] += importance(kind, photon) * flux * flux;
      };
      trace_photons(scene_, surfaces_, bvh_, trace, first, end, sink, counters[block]);
      for (uint64_t i = first; i < end; ++i)
        if (squares[i - first] > 0) of_block[block].push_back(useful_start(trace, i, squares[i - first]));
    });
    for (const auto& found : of_block) starts_.insert(starts_.end(), found.begin(), found.end());
    for (const TraceCounters& of : counters) rays_ += of.rays;
    if (rounds_.empty()) uniform_hits_ = starts_.size();
  }

  double importance(PhotonKind kind, const Photon& photon) const {
    return settings_.importance ? double(settings_.importance(kind, photon)) : 1;
  }

  Start useful_start(const TraceSettings& trace, uint64_t index, double square) const {
    const GuidedStart start = start_of(scene_, Sampler(photon_stream(trace), index), trace.guide);
    const double to_one = double(trace.photons) / double(start.weight);
    return {start.u, square * to_one * to_one};
  }

  // The starts of all rounds as if drawn from one density, the sum over the rounds of photons times density
  // (the balance heuristic, Veach 1997).
  std::vector<GuideHit> weighted() const {
    std::vector<GuideHit> hits(starts_.size());
    parallel::for_index(size_t{0}, hits.size(), [&](size_t i) {
      double density = 0;
      for (const Round& round : rounds_)
        density += round.photons * (round.guide.empty() ? 1 : double(round.guide.density(starts_[i].u)));
      hits[i] = {starts_[i].u, starts_[i].square / density};
    });
    return hits;
  }

  const Scene& scene_;
  const accel::Bvh& bvh_;
  const GuideSettings& settings_;
  SurfaceTable surfaces_{scene_};
  uint64_t rays_ = 0, uniform_hits_ = 0;
  std::vector<Round> rounds_;
  std::vector<Start> starts_;
};

}  // namespace

LearnedGuide learn_guide(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings) {
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return {};
  return GuideLearner(scene, bvh, settings).learn();
}

}  // namespace kaustik::photon
