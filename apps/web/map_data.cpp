#include "apps/web/map_data.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <deque>
#include <nlohmann/json.hpp>

#include "apps/web/json_text.h"

namespace kaustik::app {

namespace {

using Json = nlohmann::ordered_json;
using photon::PhotonKind;

struct KindOfMap {
  PhotonKind kind;
  const photon::PhotonMap& map;
};
// The page has a colour for each kind on surfaces: photons in media have those of their kind there.
uint32_t colour_of(PhotonKind kind) {
  if (kind == PhotonKind::kMediumCaustic) kind = PhotonKind::kCaustic;
  if (kind == PhotonKind::kMediumIndirect) kind = PhotonKind::kIndirect;
  return uint32_t(kind);
}

std::array<KindOfMap, photon::kPhotonKinds> all_maps(const render::PhotonMaps& maps) {
  return {{{PhotonKind::kDirect, maps.direct.map},
           {PhotonKind::kShadow, maps.shadow},
           {PhotonKind::kCaustic, maps.caustic.map},
           {PhotonKind::kIndirect, maps.indirect.map},
           {PhotonKind::kMediumCaustic, maps.medium_caustic.map},
           {PhotonKind::kMediumIndirect, maps.medium_indirect.map}}};
}

template <class T>
void append(const T& value, std::string* out) {
  char bytes[sizeof(value)];
  std::memcpy(bytes, &value, sizeof(value));
  out->append(bytes, sizeof(value));
}

// Writes the count, which is known at the end, in front.
std::string with_count(uint32_t count, const std::string& rows) {
  std::string out;
  append(count, &out);
  return out + rows;
}

// Calls fn(bounds, depth) for the stored nodes of an octree, coarse ones first, until it returns false.
template <class Fn>
void for_each_node(const photon::Octree& octree, const Fn& fn) {
  struct Place {
    uint32_t node;
    photon::MortonCell corner;
    int depth;
  };
  std::deque<Place> waiting;
  if (!octree.nodes().empty()) waiting.push_back({0, {}, 0});
  while (!waiting.empty()) {
    const Place at = waiting.front();
    waiting.pop_front();
    if (!fn(octree.cube().cell_bounds(at.corner, at.depth), at.depth)) return;
    const photon::OctreeNode& node = octree.nodes()[at.node];
    for (uint32_t octant = 0; octant < 8 && at.depth < photon::kMortonBits; ++octant) {
      if (!node.has_child(octant)) continue;
      Place child{node.child(octant), at.corner, at.depth + 1};
      for (size_t axis = 0; axis < 3; ++axis)
        child.corner[axis] |= (octant >> axis & 1) << (photon::kMortonBits - child.depth);
      waiting.push_back(child);
    }
  }
}

Json triple(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

std::string reason_of(const render::ProbedCell& cell) {
  const std::string above =
      cell.answer.climbed == 0
          ? "The leaf"
          : fmt::format("The cell {} levels above the leaf, the largest without shadow photons,",
                        cell.answer.climbed);
  switch (cell.answer.outcome) {
    case photon::LectureOutcome::kPhotons:
      return "The leaf holds no shadow photon and enough direct photons: the map answers.";
    case photon::LectureOutcome::kClimbed:
      return fmt::format("The leaf has too few photons or is too small; the cell {} levels above it answers.",
                         cell.answer.climbed);
    case photon::LectureOutcome::kFew:
      return above + " holds too few direct photons: shadow rays decide.";
    case photon::LectureOutcome::kFace:
      return above + " has a face nearer to the point than r0: shadow rays decide.";
    case photon::LectureOutcome::kShadow:
      break;
  }
  return "The leaf holds a shadow photon: shadow rays decide.";
}

std::string_view name_of(render::ProbeUse use) {
  switch (use) {
    case render::ProbeUse::kSubtracted:
      return "subtracted";
    case render::ProbeUse::kTested:
      return "tested";
    case render::ProbeUse::kRefused:
      return "refused";
    case render::ProbeUse::kAdded:
      break;
  }
  return "added";
}

Json map_json(const render::ProbedMap& map) {
  constexpr size_t kMostPhotons = 20'000;
  const size_t step = map.photons.size() / kMostPhotons + 1;
  Json photons = Json::array();
  for (size_t i = 0; i < map.photons.size(); i += step) {
    const render::ProbedPhoton& p = map.photons[i];
    photons.push_back({p.photon.p.x, p.photon.p.y, p.photon.p.z, p.photon.flux.x, p.photon.flux.y,
                       p.photon.flux.z, p.distance, p.weight});
  }
  return {{"kind", photon::kPhotonKindNames[size_t(map.kind)]},
          {"radius", map.radius},
          {"kernel", map.kernel.row().name},
          {"radiance", triple(map.radiance)},
          {"use", name_of(map.use)},
          {"accepted", map.photons.size()},
          {"photons", std::move(photons)}};
}

Json cell_json(const render::ProbedCell& cell) {
  return {{"min", triple(cell.bounds.min)}, {"max", triple(cell.bounds.max)},
          {"depth", cell.answer.depth},     {"direct", cell.direct},
          {"shadow", cell.shadow},          {"trusted", cell.answer.use_photons()},
          {"reason", reason_of(cell)}};
}

}  // namespace

std::string cloud_bytes(const render::PhotonMaps& maps, uint64_t most) {
  uint64_t all = 0;
  for (const KindOfMap& of : all_maps(maps)) all += of.map.size();
  const uint64_t step = all / std::max<uint64_t>(most, 1) + 1;
  std::string rows;
  uint32_t count = 0;
  for (const KindOfMap& of : all_maps(maps))
    for (uint64_t i = 0; i < of.map.size(); i += step, ++count) {
      const photon::Photon p = of.map.photon(i);
      append(p.p, &rows);
      append(p.flux, &rows);
      append(colour_of(of.kind), &rows);
    }
  return with_count(count, rows);
}

std::string cell_bytes(const render::PhotonMaps& maps, uint64_t most) {
  std::string rows;
  uint32_t count = 0;
  for (const KindOfMap& of : all_maps(maps)) {
    if (of.map.empty()) continue;
    uint64_t left = most / photon::kPhotonKinds;
    for_each_node(of.map.octree(), [&](const Bounds3& bounds, int depth) {
      if (left-- == 0) return false;
      append(bounds.min, &rows);
      append(bounds.max, &rows);
      append(uint32_t(depth), &rows);
      append(colour_of(of.kind), &rows);
      ++count;
      return true;
    });
  }
  return with_count(count, rows);
}

std::string probe_json(const render::Probe& probe, const Scene& scene) {
  Json hit;
  if (probe.point)
    hit = {{"point", triple(probe.point->p)},
           {"normal", triple(probe.point->n)},
           {"distance", probe.distance},
           {"specular", probe.specular},
           {"material", scene.material_names[probe.point->material]}};
  Json maps = Json::array();
  for (const render::ProbedMap& map : probe.maps) maps.push_back(map_json(map));
  const Json out = {{"hit", std::move(hit)},
                    {"maps", std::move(maps)},
                    {"cell", probe.cell ? cell_json(*probe.cell) : Json(nullptr)}};
  return json_text(out);
}

}  // namespace kaustik::app
