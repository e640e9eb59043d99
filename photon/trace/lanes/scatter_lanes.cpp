// Scattering and Russian roulette in SIMD lanes (Google Highway): the operations of core/bsdf and of the
// tracer's scalar code in the same order. Nothing is fused and nothing approximated, so the results do not
// depend on the instruction set.

#include "photon/trace/lanes/vertex_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/trace/lanes/scatter_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/trace/energy/energy_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

using Words = hn::RebindToUnsigned<Floats>;

// Mask of the lanes whose surface has the trait.
HWY_INLINE Mask Have(const VertexLanes& lanes, uint32_t trait, size_t k) {
  const Words w;
  return hn::RebindMask(Floats(), hn::TestBit(hn::Load(w, lanes.traits + k), hn::Set(w, trait)));
}
HWY_INLINE bool Any(Mask mask) {
  return !hn::AllFalse(Floats(), mask);
}
HWY_INLINE Vec3<Vf> Select(Mask mask, const Vec3<Vf>& yes, const Vec3<Vf>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

// A direction sampled in the frame about n, and the weight by which the flux is multiplied.
struct Scattered {
  Vec3<Vf> wi, weight;
};

// Direction of Dielectric::sample_f, or of Mirror::sample_f where eta is zero. The weight of both is
// SurfaceRow::reflectance, so it is not computed here.
HWY_INLINE Vec3<Vf> SampleSpecular(const Vec3<Vf>& wo, Vf eta, Mask refracts, Vf uc) {
  const Floats d;
  const Vf one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const Mask outside = hn::Gt(wo.z, zero);
  const Vf relative = hn::IfThenElse(outside, eta, hn::Div(one, eta));
  const Vf cos_i = hn::Min(hn::Abs(wo.z), one);
  // These lines are refracted_cosine().
  const Vf sin2_i = hn::Max(zero, hn::Mul(hn::Sub(one, cos_i), hn::Add(one, cos_i)));
  const Vf sin2_t = hn::Div(sin2_i, hn::Mul(relative, relative));
  const Mask passes = hn::Lt(sin2_t, one);
  const Vf cos_t = hn::Sqrt(hn::IfThenElseZero(passes, hn::Sub(one, sin2_t)));
  // These lines are fresnel_from_cosines().
  const Vf eta_i = hn::Mul(relative, cos_i), eta_t = hn::Mul(relative, cos_t);
  const Vf parallel = hn::Div(hn::Sub(eta_i, cos_t), hn::Add(eta_i, cos_t));
  const Vf perpendicular = hn::Div(hn::Sub(cos_i, eta_t), hn::Add(cos_i, eta_t));
  const Vf squares = hn::Add(hn::Mul(parallel, parallel), hn::Mul(perpendicular, perpendicular));
  const Vf reflectance = hn::IfThenElse(passes, hn::Mul(hn::Set(d, 0.5f), squares), one);
  const Mask through = hn::AndNot(hn::Lt(uc, reflectance), refracts);
  const Vf inverse = hn::Div(one, relative);
  const Vf x = hn::Neg(wo.x), y = hn::Neg(wo.y);
  const Vec3<Vf> refracted{hn::Mul(x, inverse), hn::Mul(y, inverse),
                           hn::IfThenElse(outside, hn::Neg(cos_t), cos_t)};
  const Vec3<Vf> wi = Select(through, refracted, {x, y, wo.z});
  const Mask nothing = hn::And(refracts, hn::Eq(eta, one));
  return Select(nothing, {x, y, hn::Neg(wo.z)}, wi);
}

// Factor by which OrenNayar's value differs from a Lambertian one.
HWY_INLINE Vf RoughFactor(const VertexLanes& lanes, const Vec3<Vf>& wo, const Vec3<Vf>& wi, size_t k) {
  const Floats d;
  const Vf A = hn::Load(d, lanes.parameter[0] + k), B = hn::Load(d, lanes.parameter[1] + k);
  const Vf tangential = hn::Max(hn::Zero(d), hn::Add(hn::Mul(wo.x, wi.x), hn::Mul(wo.y, wi.y)));
  return hn::Add(A, hn::Div(hn::Mul(B, tangential), hn::Max(hn::Abs(wo.z), hn::Abs(wi.z))));
}

// Samples wi in the frame about n; the mask tells where a direction was found.
HWY_INLINE Mask SampleBsdf(const VertexLanes& lanes, const SobolLanes& numbers, size_t k, Scattered& out) {
  const Floats d;
  const Vf zero = hn::Zero(d), wo_z = hn::Neg(hn::Load(d, lanes.cos_in + k));
  Vec3<Vf> wi = SampleCosineHemisphere(hn::Load(d, numbers.u[0] + k), hn::Load(d, numbers.u[1] + k));
  wi.z = hn::IfThenElse(hn::Lt(wo_z, zero), hn::Neg(wi.z), wi.z);
  const Mask same_side = hn::Gt(hn::Mul(wo_z, wi.z), zero);
  out = {wi, Load(lanes.reflectance, k)};
  const Mask rough = Have(lanes, kRoughTrait, k), specular = Have(lanes, kSpecularTrait, k);
  if (!Any(hn::Or(rough, specular))) return same_side;
  const Vec3<Vf> along = Load(lanes.ray.d, k);
  const Vec3<Vf> wo = ToLocal(Load(lanes.n, k), {hn::Neg(along.x), hn::Neg(along.y), hn::Neg(along.z)});
  out.weight = Select(rough, RoughFactor(lanes, wo, wi, k) * out.weight, out.weight);
  const Vf eta = hn::Load(d, lanes.parameter[0] + k), uc = hn::Load(d, numbers.u[2] + k);
  out.wi = Select(specular, SampleSpecular(wo, eta, Have(lanes, kDielectricTrait, k), uc), wi);
  return hn::Or(hn::And(specular, hn::Ne(wo_z, zero)), hn::AndNot(specular, same_side));
}

// Samples the next direction in world space and the factor for the flux; the mask tells where there is one.
HWY_INLINE Mask SampleDirection(const VertexLanes& lanes, const SobolLanes& numbers, size_t k,
                                Scattered& out) {
  const Floats d;
  const Mask some = SampleBsdf(lanes, numbers, k, out);
  const Vec3<Vf> n = Load(lanes.n, k);
  const Vf wi_z = out.wi.z;
  const Vec3<Vf> w = ToWorld(n, out.wi);
  // These lines are unit() of tracer-inl.h.
  const Vf step = hn::Sub(hn::Set(d, 1.5f), hn::Mul(hn::Set(d, 0.5f), Dot(w, w)));
  out.wi = step * w;
  return hn::And(some, hn::Gt(hn::Mul(Dot(out.wi, n), wi_z), hn::Zero(d)));
}

// Russian roulette. `flux` arrived, `next` is left after reflection; `out` is the flux of the survivors.
// Returns each lane's Fate.
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> Roulette(const Vec3<Vf>& flux, const Vec3<Vf>& next, Vf u,
                                                        Vec3<Vf>& out) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  const Vf zero = hn::Zero(d);
  const Vf before = Largest(flux), after = Largest(next);
  const auto is_flux = [&](Vf x)
                           HWY_ATTR { return hn::And(hn::Ge(x, zero), hn::Lt(x, hn::Set(d, kInfinity))); };
  const Mask valid = hn::And(is_flux(next.x), hn::And(is_flux(next.y), is_flux(next.z)));
  const Mask dims = hn::Lt(after, before);
  const Mask alive = hn::And(hn::Gt(after, zero), hn::Or(hn::Not(dims), hn::Lt(hn::Mul(u, before), after)));
  out = hn::IfThenElse(dims, hn::Div(before, after), hn::Set(d, 1.0f)) * next;
  const auto as_alive = hn::IfThenElseZero(hn::RebindMask(i, alive), hn::Set(i, VertexLanes::kAlive));
  return hn::IfThenElse(hn::RebindMask(i, valid), as_alive, hn::Set(i, VertexLanes::kInvalid));
}

void ScatterLanes(VertexLanes& lanes, const SobolLanes& numbers, float units_per_watt, size_t count) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  const Vf scale = hn::Set(d, units_per_watt);
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    Scattered next;
    Vec3<Vf> flux_left;
    const Mask scattered = SampleDirection(lanes, numbers, k, next);
    const Vf u = hn::IfThenElse(Have(lanes, kSpecularTrait, k), hn::Load(d, numbers.u[3] + k),
                                hn::Load(d, numbers.u[2] + k));
    const Vec3<Vf> flux = next.weight * Load(lanes.flux, k);
    const auto fate =
        hn::IfThenElseZero(hn::RebindMask(i, scattered), Roulette(Load(lanes.flux, k), flux, u, flux_left));
    hn::Store(fate, i, lanes.fate + k);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(i, scattered), Energy(flux, scale)), i,
              lanes.scattered_energy + k);
    hn::Store(hn::IfThenElseZero(hn::Eq(fate, hn::Set(i, VertexLanes::kAlive)), Energy(flux_left, scale)), i,
              lanes.next_energy + k);
    Store(next.wi, lanes.next.d, k);
    Store(flux_left, lanes.next_flux, k);
    // These lines are offset_origin().
    const Vec3<Vf> n = Load(lanes.n, k), p = Load(lanes.p, k);
    const Vf p_error = hn::Load(d, lanes.p_error + k);
    const Mask behind = hn::Lt(Dot(next.wi, n), hn::Zero(d));
    Store(p + hn::IfThenElse(behind, hn::Neg(p_error), p_error) * n, lanes.next.o, k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(ScatterLanes);

void scatter_lanes(VertexLanes& lanes, const SobolLanes& numbers, float units_per_watt, size_t count) {
  HWY_DYNAMIC_DISPATCH(ScatterLanes)(lanes, numbers, units_per_watt, count);
}

}  // namespace kaustik::photon
#endif
