#include "apps/import/gltf/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace kaustik::gltf {
namespace {

enum class Interpolation { kLinear, kStep, kCubic };

// The keys of a channel. Each key has `width` values; those of cubic splines have an in-tangent before and an
// out-tangent after them.
struct Track {
  std::vector<double> times, values;
  size_t width = 0;
  Interpolation interpolation = Interpolation::kLinear;

  // Part 0 to 2 of a cubic key is its in-tangent, value and out-tangent.
  const double* key(size_t i, size_t part = 1) const {
    const size_t parts = interpolation == Interpolation::kCubic ? 3 : 1;
    return values.data() + (parts * i + (parts == 3 ? part : 0)) * width;
  }
};

// Interpolates quaternions along the shorter arc of the sphere.
std::vector<double> slerp(const double* a, const double* b, double t) {
  double cosine = 0;
  for (int k = 0; k < 4; ++k) cosine += a[k] * b[k];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(std::abs(cosine), 1.0));
  // Where the sine is lost to rounding, the arc is a line.
  const bool straight = angle < 1e-6;
  const double wa = straight ? 1 - t : std::sin((1 - t) * angle) / std::sin(angle);
  const double wb = sign * (straight ? t : std::sin(t * angle) / std::sin(angle));
  std::vector<double> out(4);
  for (size_t k = 0; k < 4; ++k) out[k] = wa * a[k] + wb * b[k];
  return out;
}

// Hermite spline of glTF 2.0, appendix C.5; `step` is the time between the keys.
std::vector<double> spline(const Track& track, size_t i, double t, double step) {
  const double t2 = t * t, t3 = t2 * t;
  std::vector<double> out(track.width);
  for (size_t k = 0; k < track.width; ++k)
    out[k] = (2 * t3 - 3 * t2 + 1) * track.key(i)[k] + step * (t3 - 2 * t2 + t) * track.key(i, 2)[k] +
             (-2 * t3 + 3 * t2) * track.key(i + 1)[k] + step * (t3 - t2) * track.key(i + 1, 0)[k];
  return out;
}

std::vector<double> sample(const Track& track, double seconds, bool rotation) {
  const auto after = std::upper_bound(track.times.begin(), track.times.end(), seconds);
  const auto next = static_cast<size_t>(after - track.times.begin());
  const size_t last = track.times.size() - 1, i = next == 0 ? 0 : next - 1;
  const std::vector<double> held(track.key(i), track.key(i) + track.width);
  if (next == 0 || i == last || track.interpolation == Interpolation::kStep) return held;
  const double step = track.times[i + 1] - track.times[i], t = (seconds - track.times[i]) / step;
  if (track.interpolation == Interpolation::kCubic) return spline(track, i, t, step);
  if (rotation) return slerp(track.key(i), track.key(i + 1), t);
  std::vector<double> out(track.width);
  for (size_t k = 0; k < out.size(); ++k) out[k] = (1 - t) * track.key(i)[k] + t * track.key(i + 1)[k];
  return out;
}

Interpolation interpolation_of(const View& sampler) {
  const std::string name = sampler["interpolation"].text("LINEAR");
  return name == "STEP"          ? Interpolation::kStep
         : name == "CUBICSPLINE" ? Interpolation::kCubic
                                 : Interpolation::kLinear;
}

// Nothing when keys and values do not fit together. `components`: numbers per value; 1 for weights, whose
// number follows from the keys.
std::optional<Track> track_of(const Document& document, const View& sampler, int components) {
  const auto input = sampler["input"].index(document.size("accessors"));
  const auto output = sampler["output"].index(document.size("accessors"));
  if (!input || !output) return std::nullopt;
  Track track;
  track.interpolation = interpolation_of(sampler);
  track.times = document.elements(*input, 1).values;
  track.values = document.elements(*output, components).values;
  const size_t parts = track.interpolation == Interpolation::kCubic ? 3 : 1;
  if (track.times.empty() || !std::is_sorted(track.times.begin(), track.times.end())) return std::nullopt;
  track.width = track.values.size() / (track.times.size() * parts);
  const bool fits = components == 1 || track.width == static_cast<size_t>(components);
  if (!fits || track.width == 0 || track.values.size() != track.width * track.times.size() * parts)
    return std::nullopt;
  return track;
}

}  // namespace

Pose::Pose(const Document& document, double seconds, FileWarnings& warnings) {
  for (uint64_t i = 0; i < document.size("animations"); ++i) {
    const View animation = document.item("animations", i), channels = animation["channels"];
    for (uint64_t c = 0; c < channels.size(); ++c)
      add_channel(document, animation, channels.at(c), seconds, warnings);
  }
}

void Pose::add_channel(const Document& document, const View& animation, const View& channel, double seconds,
                       FileWarnings& warnings) {
  const View target = channel["target"], samplers = animation["samplers"];
  const std::string path = target["path"].text();
  const auto node = target["node"].index(document.size("nodes"));
  const auto sampler = channel["sampler"].index(samplers.size());
  if (path == "pointer") return warnings.count("animations of anything but nodes are left out", "channel");
  if (!node || !sampler) return;
  NodePose& pose = nodes_[*node];
  const bool rotation = path == "rotation";
  auto* part = rotation                ? &pose.rotation
               : path == "translation" ? &pose.translation
               : path == "scale"       ? &pose.scale
               : path == "weights"     ? &pose.weights
                                       : nullptr;
  if (!part || *part) return;
  const int components = part == &pose.weights ? 1 : rotation ? 4 : 3;
  const auto track = track_of(document, samplers.at(*sampler), components);
  if (!track) return warnings.count("animations whose keys and values do not fit are left out", "channel");
  duration_ = std::max(duration_, track->times.back());
  *part = sample(*track, seconds, rotation);
}

const NodePose* Pose::of(uint64_t node) const {
  const auto found = nodes_.find(node);
  return found == nodes_.end() ? nullptr : &found->second;
}

}  // namespace kaustik::gltf
