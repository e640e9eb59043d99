#pragma once
// Glossy lobes have a bright core and faint tails. A light that a path meets by way of further specular
// surfaces, after it left a glossy lobe by its tail, is as bright as one met by the core, but is met seldom:
// an isolated bright pixel. Photons find the same light from the other side, and under the tail, which is as
// smooth as a diffuse lobe, their estimate has little noise. So each direction wi at a glossy surface x has
// one owner of the light that reaches x along it from a light by way of specular surfaces alone (L S+ x):
//
//   pdf_glossy(wo, wi) >= kTailPdf   paths, which sample such directions often
//   pdf_glossy(wo, wi) <  kTailPdf   the caustic map
//
// All other light along wi is left to paths and light samples: emission met straight from x, and what diffuse
// surfaces reflect. If several surfaces of a chain are left by their tails, the first from the eye decides.

#include "render/estimators/lighting.h"

namespace kaustik::render {

// Density in 1/sr below which a direction belongs to the tail; the diffuse lobe's largest is 1/pi.
inline constexpr float kTailPdf = 3;

// Whether the tails of x's glossy lobes are gathered. Coats reflect too little for that.
inline bool gathers_tail(const RenderContext& ctx, const ShadingPoint& x) {
  const Lobes parts = lobes(*x.bsdf);
  return ctx.plan.glossy_tails && parts.glossy && !parts.diffuse && !transmits(*x.bsdf);
}

inline bool in_tail(const ShadingPoint& x, const Vector3& wi) {
  return scatter_pdf(x, wi, LobePart::kGlossy) < kTailPdf;
}

// How a chain of specular events stands to the tails on it.
enum class Tail {
  kNone,   // no tail on it
  kLeft,   // the last event was in a tail
  kBehind  // events followed one in a tail: lights that are met belong to the caustic map
};
inline Tail behind_event(Tail tail) {
  return tail == Tail::kNone ? Tail::kNone : Tail::kBehind;
}

}  // namespace kaustik::render
