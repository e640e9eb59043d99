#pragma once
// Division of light between photons and paths from the camera, by where the light comes from.

#include <cmath>

#include "core/scene/scene.h"
#include "photon/sources/irradiance_tree.h"

namespace kaustik::photon {

// Light transport is linear in its sources, so each source may have an estimator of its own. The sources are
//   the lights themselves, for light that leaves them through specular surfaces, and
//   the surfaces where light first falls on diffuse lobes, for what these scatter on.
// Photons carry the share w of a source and paths the share 1 - w, so the sum is right whatever w is. Photons
// find bright and small sources, which paths seldom meet; paths have no bias near other surfaces. A source
// counts as bright by its radiance L, that of a surface being its irradiance over pi:
// w = L / (L + L0). Light of a surface that falls there through specular surfaces is carried on by
// photons with the share 1 - (1 - w of the light) (1 - w of the surface), since no path may find it.
class SourceSplit {
 public:
  // firsts: the photons that few emitted ones left where they first met diffuse lobes. balance: L0,
  // W/(m^2 sr); 0: photons carry all, infinite: paths all but what no ray can hit.
  SourceSplit(const Scene& scene, const std::vector<Photon>& firsts, float balance);

  void set_balance(float balance) { balance_ = balance; }
  // Whether paths have any share.
  bool leaves_to_paths() const { return balance_ > 0; }

  // Share of photons in what a surface at p scatters on of the light that comes straight from the lights. n:
  // normal on the side of the light; both_sides: the surface scatters through, so either side counts.
  float of_surface(const Point3& p, const Normal3& n, bool both_sides) const {
    if (std::isinf(balance_)) return 0;  // whatever the radiance is: it is finite
    return share_of(radiance_of_surface(p, n, both_sides));
  }

  // Share of photons in what a light sends through specular surfaces. to_light: a ray that meets it, of unit
  // direction.
  float of_light(uint32_t light, const Ray& to_light) const {
    return share_of(radiance_of_light(light, to_light));
  }

  // Share of photons in the light of a source of radiance L.
  float share_of(float L) const {
    if (balance_ == 0) return 1;
    if (!(L > 0)) return 0;
    return std::isinf(L) ? 1 : 1 / (1 + balance_ / L);
  }

  // Radiance of these sources, W/(m^2 sr); infinite for lights that no ray can hit.
  float radiance_of_surface(const Point3& p, const Normal3& n, bool both_sides) const;
  float radiance_of_light(uint32_t light, const Ray& to_light) const;

 private:
  const Scene* scene_;
  IrradianceTree tree_;
  float balance_;
  std::vector<float> radiance_;  // of each light; infinite where no ray can hit it
};

}  // namespace kaustik::photon
