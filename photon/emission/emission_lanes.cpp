// Photon starts on triangles in SIMD lanes (Google Highway): the operations of core/light/area/area.cpp in
// the same order.

#include "photon/emission/emission_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/emission/emission_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/lanes/vector_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

// Same operations as surface_error() for a point on a triangle.
HWY_INLINE Vf TriangleError(const Vec3<Vf>& p, const Vec3<Vf>& e1, const Vec3<Vf>& e2) {
  const Floats d;
  const Vf extent = hn::Add(LargestMagnitude(e1), LargestMagnitude(e2));
  return hn::Add(hn::Mul(hn::Set(d, gamma_bound(6)), LargestMagnitude(p)),
                 hn::Mul(hn::Set(d, gamma_bound(16)), extent));
}

void StartOnTriangles(EmissionLanes& lanes, size_t count) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto u = [&](int c) HWY_ATTR { return hn::Load(d, lanes.u[c] + k); };
    const Vf half = hn::Mul(hn::Set(d, 0.5f), hn::Min(u(0), u(1)));
    const Vf b1 = hn::Sub(u(0), half), b2 = hn::Sub(u(1), half);
    const Vec3<Vf> e1 = Load(lanes.e1, k), e2 = Load(lanes.e2, k), n = Load(lanes.n, k);
    const Vec3<Vf> p = Load(lanes.p0, k) + (b1 * e1 + b2 * e2);
    Store(p + TriangleError(p, e1, e2) * n, lanes.ray.o, k);
    const Vec3<Vf> local = SampleCosineHemisphere(u(2), u(3));
    Store(ToWorld(n, local), lanes.ray.d, k);
    const auto up = hn::RebindMask(i, hn::Gt(local.z, hn::Zero(d)));
    hn::Store(hn::IfThenElseZero(up, hn::Set(i, 1)), i, lanes.emitted + k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(StartOnTriangles);

namespace {

// The light that a photon of the group chooses. What depends on the light alone is kept, since the next
// photon mostly chooses the same one.
class ChosenLight {
 public:
  ChosenLight(const Scene& scene, uint64_t total, EmissionMode mode, std::optional<uint32_t> only)
      : scene_(scene), total_(total), mode_(mode), only_(only) {}

  void choose(float u_light) {
    const LightOfPhoton chosen = light_of_photon(scene_, u_light, only_);
    set(chosen.light, chosen.p);
  }
  // Null when the light's photons cannot be started in lanes.
  const TriangleEmitter* triangles() const { return triangles_; }
  bool twosided() const { return area_->twosided; }
  const Rgb& flux() const { return flux_; }

 private:
  void set(uint32_t light, float p_light) {
    if (area_ && light == light_) return;
    light_ = light;
    triangles_ = nullptr;
    area_ = std::get_if<DiffuseAreaLight>(&scene_.lights[light]);
    if (!area_ || area_->image || mode_ != EmissionMode::kCosine) return;
    triangles_ = std::get_if<TriangleEmitter>(&area_->surface);
    flux_ = area_->power() * static_cast<float>(1 / (double{p_light} * static_cast<double>(total_)));
  }

  const Scene& scene_;
  uint64_t total_;
  EmissionMode mode_;
  std::optional<uint32_t> only_;
  uint32_t light_ = 0;
  const DiffuseAreaLight* area_ = nullptr;
  const TriangleEmitter* triangles_ = nullptr;
  Rgb flux_{0};
};

void set_start(EmissionLanes& lanes, size_t k, const ChosenLight& light) {
  const auto& u = lanes.position_direction.u;
  const DiscreteDistribution::Sample choice = light.triangles()->by_area.sample(u[0][k]);
  const TriangleEmitter::Triangle& t = light.triangles()->triangles[choice.index];
  lanes.u[0][k] = choice.u_remapped;
  lanes.u[1][k] = u[1][k];
  lanes.u[2][k] = u[2][k];
  lanes.u[3][k] = u[3][k];
  float side = 1;
  if (light.twosided()) {
    side = u[2][k] < 0.5f ? 1.0f : -1.0f;
    lanes.u[2][k] = u[2][k] < 0.5f ? 2 * u[2][k] : 2 * u[2][k] - 1;
  }
  set_lane(lanes.p0, k, t.p0);
  set_lane(lanes.e1, k, t.e1);
  set_lane(lanes.e2, k, t.e2);
  set_lane(lanes.n, k, side * t.n);
  set_lane(lanes.flux, k, light.flux());
}

void set_start(EmissionLanes& lanes, size_t k, const std::optional<EmissionSample>& start) {
  lanes.emitted[k] = !start ? 0 : start->from_sky ? EmissionLanes::kFromSky : 1;
  if (!start) return;
  set_lane(lanes.ray.o, k, start->ray.o);
  set_lane(lanes.ray.d, k, start->ray.d);
  set_lane(lanes.flux, k, start->flux);
}

}  // namespace

void emit_lanes(const Scene& scene, uint64_t total, EmissionMode mode, size_t count, EmissionLanes& lanes,
                std::optional<uint32_t> only) {
  std::fill_n(lanes.emitted, count, 0);
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return;
  ChosenLight light(scene, total, mode, only);
  bool in_lanes[kPhotonLanes];
  for (size_t k = 0; k < count; ++k) {
    light.choose(lanes.u_light[k]);
    in_lanes[k] = light.triangles() != nullptr;
    if (in_lanes[k]) set_start(lanes, k, light);
  }
  HWY_DYNAMIC_DISPATCH(StartOnTriangles)(lanes, count);
  for (size_t k = 0; k < count; ++k) {
    if (in_lanes[k]) continue;
    const auto& u = lanes.position_direction.u;
    const EmissionNumbers numbers{{u[0][k], u[1][k]}, {u[2][k], u[3][k]}, lanes.u_light[k]};
    set_start(lanes, k, emit_photon(scene, numbers, total, mode, only));
  }
}

}  // namespace kaustik::photon
#endif
