// The table of transmittances of rough coats: how it is integrated and interpolated.

#include "core/bsdf/microfacet/rough_coat.h"

#include <array>

#include "core/bsdf/microfacet/fresnel.h"

namespace kaustik {

namespace {

constexpr int kNodes = RoughTransmittance::kNodes;  // per axis
// Number of facets sampled per direction: points of a Fibonacci lattice, which are even up to the edges.
constexpr int kFacets = 233;

// Shares of the light from wo that facets transmit and reflect.
struct Shares {
  double through = 0, back = 0;
};

// relative: index of the far side over that of wo's side.
Shares shares_of(const Ggx& facets, float relative, const Vector3& wo) {
  Shares sum;
  for (int k = 0; k < kFacets; ++k) {
    const Point2 u((float(k) + 0.5f) / kFacets, (float(k * 144 % kFacets) + 0.5f) / kFacets);
    const Vector3 wm = facets.sample_visible(wo, u);
    const float cos_i = std::clamp(glm::dot(wo, wm), 0.0f, 1.0f), cos_t = refracted_cosine(cos_i, relative);
    const float F = fresnel_from_cosines(cos_i, cos_t, relative);
    const Vector3 reflected = 2 * cos_i * wm - wo;
    if (reflected.z > 0) sum.back += double(F * facets.unshadowed(wo, reflected));
    const Vector3 refracted = (cos_i / relative - cos_t) * wm - wo / relative;
    if (F < 1 && refracted.z < 0) sum.through += double((1 - F) * facets.unshadowed(wo, refracted));
  }
  return {sum.through / kFacets, sum.back / kFacets};
}

// The nodes are evenly spaced in (eta - 1) / (eta + 1), in alpha and in the square root of the cosine.
constexpr float kLargestS = (kLargestCoatEta - 1) / (kLargestCoatEta + 1);
float node(int i) {
  return float(i) / (kNodes - 1);
}
float eta_of_node(int i) {
  const float s = node(i) * kLargestS;
  return (1 + s) / (1 - s);
}
Ggx facets_of_node(int i) {
  const float alpha = std::max(node(i), Ggx::kSmoothAlpha);
  return {alpha, alpha};
}
Vector3 direction_of_node(int i) {
  const float z = std::max(node(i) * node(i), 1e-4f);
  return {std::sqrt((1 - z) * (1 + z)), 0, z};
}

struct Table {
  float through[kNodes][kNodes][kNodes];  // eta, alpha, cosine
  float inner[kNodes][kNodes];            // eta, alpha

  Table() {
    for (int e = 0; e < kNodes; ++e) {
      for (int a = 0; a < kNodes; ++a) {
        const float eta = eta_of_node(e);
        for (int c = 0; c < kNodes; ++c)
          through[e][a][c] = float(shares_of(facets_of_node(a), eta, direction_of_node(c)).through);
        inner[e][a] = float(inner_of(facets_of_node(a), eta));
      }
    }
  }
  // Mean over the square of the cosine, which is distributed uniformly for uniform light.
  static double inner_of(const Ggx& facets, float eta) {
    constexpr int kDirections = 24;
    double sum = 0;
    for (int i = 0; i < kDirections; ++i) {
      const float z2 = (float(i) + 0.5f) / kDirections;
      sum += shares_of(facets, 1 / eta, {std::sqrt(1 - z2), 0, std::sqrt(z2)}).back;
    }
    return sum / kDirections;
  }
};

const Table& table() {
  static const Table made;
  return made;
}

// Position between two adjacent nodes, for linear interpolation.
struct Between {
  int i;
  float t;

  explicit Between(float x) {
    const float at = x > 0 ? std::min(x, 1.0f) * (kNodes - 1) : 0;  // zero for NaN, too
    i = std::min(int(at), kNodes - 2);
    t = at - float(i);
  }
  float mix(float a, float b) const { return a + t * (b - a); }
};
Between between_etas(float eta) {
  return Between((eta - 1) / (eta + 1) / kLargestS);
}

}  // namespace

float rough_transmittance(float cos_theta, float alpha, float eta) {
  const Between e = between_etas(eta), a(alpha), c(std::sqrt(std::min(cos_theta, 1.0f)));
  const auto& T = table().through;
  const auto at = [&](int i, int j) { return c.mix(T[i][j][c.i], T[i][j][c.i + 1]); };
  return e.mix(a.mix(at(e.i, a.i), at(e.i, a.i + 1)), a.mix(at(e.i + 1, a.i), at(e.i + 1, a.i + 1)));
}

RoughTransmittance::RoughTransmittance(float alpha, float eta) {
  const Between e = between_etas(eta), a(alpha);
  const auto& T = table().through;
  const auto *const low = T[e.i], *const high = T[e.i + 1];
  for (int c = 0; c < kNodes; ++c)
    through_[c] = e.mix(a.mix(low[a.i][c], low[a.i + 1][c]), a.mix(high[a.i][c], high[a.i + 1][c]));
}

float rough_inner_reflectance(float alpha, float eta) {
  const Between e = between_etas(eta), a(alpha);
  const auto& R = table().inner;
  return e.mix(a.mix(R[e.i][a.i], R[e.i][a.i + 1]), a.mix(R[e.i + 1][a.i], R[e.i + 1][a.i + 1]));
}

}  // namespace kaustik
