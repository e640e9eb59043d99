#pragma once
// How far light goes in a medium before it is scattered.

#include <optional>

#include "core/medium/medium.h"

namespace kaustik {

// The share that each channel has in the light, so that a mixture of the channels' distributions never makes
// the light's sum over the channels grow.
inline Rgb channel_shares(const Rgb& light) {
  const float sum = light.x + light.y + light.z;
  return sum > 0 && sum < kInfinity ? light / sum : Rgb(1.0f / 3);
}

// An entry of a distribution over the three channels: u in [0, 1) chooses it, and `rest` is what is left of
// u, again uniform in [0, 1).
struct ChosenChannel {
  int channel;
  float rest;
};
inline ChosenChannel choose_channel(const Rgb& shares, float u) {
  for (int c = 0; c < 2; ++c) {
    if (u < shares[c]) return {c, u / shares[c]};
    u -= shares[c];
  }
  return {2, shares.z > 0 ? std::min(u / shares.z, kOneMinusEpsilon) : 0};
}

// How far light of one colour goes through media, one after the other, until one of them scatters it: drawn
// from a mixture of the channels' distributions. Media that only absorb scatter nothing, so that they take
// their share for sure. Distances are column densities, which in media of density one are lengths.
class FreePath {
 public:
  // u in [0, 1)^2.
  FreePath(const Rgb& light, const Point2& u) : shares_(channel_shares(light)) {
    const ChosenChannel chosen = choose_channel(shares_, u.x);
    channel_ = chosen.channel, rest_ = chosen.rest;
    depth_ = -std::log1p(-u.y);
  }

  // Goes through a column density of a medium, in metres, which may be infinite. Returns the column density
  // after which the light is scattered; nothing where it gets through.
  std::optional<float> pass(const Medium& medium, float column) {
    const Rgb sigma_t = medium.sigma_t();
    if (!medium.scatters()) {
      absorbed_ *= exponential(sigma_t, column);
      return {};
    }
    const float sigma = sigma_t[channel_], depth = sigma > 0 ? sigma * column : 0;
    const bool scattered = depth > depth_;
    const float passed = scattered ? depth_ / sigma : column;
    left_ *= exponential(sigma_t, passed);
    depth_ -= depth;
    return scattered ? std::optional(passed) : std::nullopt;
  }

  // The share of the light that is neither absorbed nor scattered up to here.
  Rgb transmittance() const { return absorbed_ * left_; }
  // Factor on the light that this medium has scattered: sigma_s T / pdf.
  Rgb scattered(const Medium& medium) const {
    return medium.sigma_s * transmittance() * inverse(glm::dot(shares_, medium.sigma_t() * left_));
  }
  // Factor on the light that has passed all media: T / probability.
  Rgb passed() const { return transmittance() * inverse(glm::dot(shares_, left_)); }
  // What is left of u.x, again uniform in [0, 1).
  float rest() const { return rest_; }

 private:
  // Events that cannot happen carry nothing.
  static float inverse(float density) { return density > 0 ? 1 / density : 0; }

  Rgb shares_, absorbed_{1}, left_{1};
  int channel_ = 0;
  float rest_ = 0, depth_ = 0;  // optical depth, in the chosen channel, until the light is scattered
};

// The place where light is scattered that is scattered within a column density, which may be infinite: the
// same distribution, cut off there. Places are column densities, too.
class ScatteringPlace {
 public:
  ScatteringPlace(const Medium& medium, const Rgb& light, float column)
      : sigma_s_(medium.sigma_s), sigma_t_(medium.sigma_t()), column_(column) {
    for (int c = 0; c < 3; ++c) met_[c] = sigma_t_[c] > 0 ? -std::expm1(-sigma_t_[c] * column) : 0;
    shares_ = channel_shares(light) * met_;
    opacity_ = shares_.x + shares_.y + shares_.z;
    if (opacity_ > 0) shares_ /= opacity_;
  }

  // The part of the light that does not get through. Where it is zero, nothing may be drawn.
  float opacity() const { return opacity_; }
  // Metres. u in [0, 1)^2.
  float sample(const Point2& u) const {
    const int c = choose_channel(shares_, u.x).channel;
    return std::min(-std::log1p(-u.y * met_[c]) / sigma_t_[c], column_);
  }
  // Density of sample(), per metre of column density.
  float pdf(float column) const {
    float sum = 0;
    for (int c = 0; c < 3; ++c)
      if (shares_[c] > 0) sum += shares_[c] * sigma_t_[c] * std::exp(-sigma_t_[c] * column) / met_[c];
    return sum;
  }
  // sigma_s T there, per metre of column density: the share of the light that is scattered.
  Rgb scattered(float column) const { return sigma_s_ * exponential(sigma_t_, column); }

 private:
  Rgb sigma_s_, sigma_t_, met_{0}, shares_{0};
  float column_, opacity_ = 0;
};

}  // namespace kaustik
