#pragma once
// What the estimates at one pixel read: for people who want to see how photon maps work.

#include <optional>
#include <vector>

#include "photon/estimate/shadow_classifier.h"
#include "photon/record/photon.h"
#include "render/maps/photon_maps.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

struct ProbedPhoton {
  photon::Photon photon;
  float distance = 0;  // from the point, metres
  float weight = 0;    // of its flux: the kernel, 1/m^2
};

// What the picture makes of an estimate.
enum class ProbeUse {
  kAdded,
  kSubtracted,  // that of shadow photons, by `signed`
  kTested,      // shadow photons of `lecture` are only counted, in the cell
  kRefused      // the lecture's test lets shadow rays decide
};

// One gather.
struct ProbedMap {
  photon::PhotonKind kind = photon::PhotonKind::kDirect;
  float radius = 0;  // of the disc, metres; smaller than that of the map with --nearest
  photon::KernelSpec kernel;
  // In Morton order, those on the far side of a surface that transmits light first. Photons behind walls are
  // among them, though the estimate leaves them out.
  std::vector<ProbedPhoton> photons;
  Rgb radiance{0};  // the estimate, W/(m^2 sr)
  ProbeUse use = ProbeUse::kAdded;
};

// The lecture's test at the point.
struct ProbedCell {
  photon::LectureAnswer answer;
  Bounds3 bounds;                   // of the cell, metres
  uint64_t direct = 0, shadow = 0;  // photons in it
};

struct Probe {
  std::optional<SurfaceInteraction> point;  // where the estimates are made; unset where the ray escapes
  float distance = 0;                       // along the ray, and the specular chain, metres
  int specular = 0;                         // points of mirrors and glass on the way
  std::vector<ProbedMap> maps;              // those that the plan gathers from
  std::optional<ProbedCell> cell;           // for `lecture`
};

// Follows the ray through the middle of pixel (x, y) of the full image, and gathers where it meets a diffuse
// lobe. Of the branches of a specular chain, one of high probability is followed. Thread-safe.
Probe probe_pixel(const RenderInput& input, const PhotonMaps& maps, int x, int y);

}  // namespace kaustik::render
