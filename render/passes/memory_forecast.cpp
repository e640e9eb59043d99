#include "render/passes/memory_forecast.h"

#include <algorithm>
#include <set>
#include <vector>

#include "accel/wall_feet.h"
#include "photon/estimate/surface_areas.h"
#include "photon/shoot/memory_estimate.h"
#include "render/film/error_estimate.h"
#include "render/film/film_totals.h"
#include "render/film/halves.h"
#include "render/maps/path_ends.h"
#include "render/maps/photon_shoots.h"

namespace kaustik::render {

namespace {

// Counts of adaptive samples, and rows of an image file that is encoded.
constexpr uint64_t kOthers = 24;

// Measured. Of a triangle that may be a wall: its box, and nodes of trees over them.
constexpr uint64_t kWall = 190;
// Of a triangle while the sides of its mesh are matched, and of a side that is an edge of its mesh or a bend.
constexpr uint64_t kSides = 50, kOpenSide = 175;
// Of a piece of a curved surface, when walls and sides are done with.
constexpr uint64_t kPiece = 100;

}  // namespace

uint64_t film_bytes_per_pixel(const RenderSettings& settings, const SceneNeeds& needs) {
  const uint64_t halves = keeps_halves(settings) ? sizeof(HalfSum) + sizeof(HalfMeans) : 0;
  const uint64_t media = needs.scattering ? sizeof(MediaSum) : 0;
  return sizeof(PixelSum) + sizeof(PixelResult) + halves + media + kOthers;
}

uint64_t sums_bytes_per_pixel(const RenderSettings& settings, const SceneNeeds& needs) {
  const uint64_t halves = keeps_halves(settings) ? sizeof(HalfTotals) : 0;
  const uint64_t media = needs.scattering ? sizeof(MediaTotals) : 0;
  return sizeof(PixelTotals) + sizeof(PixelError) + halves + media;
}

uint64_t surfaces_bytes(const Scene& scene, const SideEstimate& sides, const RenderSettings& settings) {
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  if (!kinds_needed(plan).any() && !plan.ends_paths) return 0;
  std::set<const TriangleMesh*> meshes;
  for (const Shape& shape : scene.shapes)
    if (const TriangleMesh* mesh = shape.mesh()) meshes.insert(mesh);
  std::vector<uint64_t> counts;
  for (const TriangleMesh* mesh : meshes) counts.push_back(mesh->indices.size());
  std::sort(counts.begin(), counts.end());
  uint64_t walls = 0;  // the smallest meshes come first, see find_wall_feet()
  for (const uint64_t count : counts)
    if (walls + count <= accel::kMostWallTriangles) walls += count;
  const auto edges = static_cast<uint64_t>(double(kOpenSide) * sides.open);
  const uint64_t finding = kWall * walls + kSides * (counts.empty() ? 0 : counts.back());
  const uint64_t ends = plan.ends_paths ? PathEnds::most_bytes(scene.camera) : 0;
  return std::max(finding, kPiece * photon::SurfaceAreas::most_pieces(scene)) + edges + ends;
}

uint64_t photons_bytes(const RenderInput& input, uint64_t passes) {
  const RenderSettings& settings = input.settings;
  if (!kinds_needed(input.plan).any()) return 0;
  const PassShare each = pass_share(0, passes, most_photons(settings), settings.spp);
  return photon::forecast_bytes(input.scene, input.bvh, trace_settings(settings, input.plan, each),
                                photon::PhotonUse::kMaps, may_be_guided(settings, input.plan, each.photons));
}

}  // namespace kaustik::render
