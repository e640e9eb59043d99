#pragma once
// Where paths from the camera end: what light surfaces send on, learned from photons.
//
// A path that a diffuse surface has scattered may take what else arrives at the next one from here, in place
// of going on (final gathering: Jensen 1996, "Global Illumination using Photon Maps"; from estimates that are
// made in advance: Christensen 1999, "Faster Photon Map Global Illumination"). Few photons are enough, since
// many of these places light each point of the picture.

#include <optional>
#include <unordered_map>
#include <vector>

#include "accel/edge_index.h"
#include "core/geometry/boundary_edges.h"
#include "core/math/hash.h"
#include "photon/shoot/shoot.h"
#include "photon/sources/source_split.h"
#include "render/explore/place_grid.h"

namespace kaustik::render {

// Immutable; thread-safe.
class PathEnds {
 public:
  // Shoots photons that carry what `split` leaves to paths; null: all light. edges, bends: those of the
  // scene. A function of scene and settings; exact under scaling of the scene by powers of two. progress: of
  // the shoot; if it cancels, the object is not to be used.
  PathEnds(const RenderInput& input, const photon::SourceSplit* split, const accel::EdgeIndex& edges,
           const std::vector<SurfaceBend>& bends, const photon::ShootProgress& progress);

  // Upper bound of the bytes that making it takes, besides what is known of surfaces.
  static uint64_t most_bytes(const Camera& camera);

  bool empty() const { return radiance_.empty(); }
  // Radius of the discs from which the light was estimated, metres.
  float radius() const { return radius_; }
  // What the surface group scatters at p, were it white, of the light that does not come straight from
  // lights: radiance, W/(m^2 sr). n: on the side of the light. Nothing where it is not known.
  std::optional<Rgb> at(const Point3& p, const Normal3& n, uint32_t group) const {
    const auto found = radiance_.find(key(p, n, group));
    return found == radiance_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  uint64_t key(const Point3& p, const Normal3& n, uint32_t group) const {
    return hash_combine(grid_.key(p, n), group);
  }

  float radius_ = 0;
  PlaceGrid grid_;
  std::unordered_map<uint64_t, Rgb> radiance_;  // by key()
};

}  // namespace kaustik::render
