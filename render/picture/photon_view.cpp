// Projects photons to pixels, counts them, and blends their colours over a dim view of the scene.

#include "render/picture/photon_view.h"

#include <tbb/blocked_range.h>

#include <array>
#include <atomic>
#include <cmath>

#include "core/parallel/parallel.h"
#include "core/spectrum/srgb.h"
#include "render/picture/tonemap.h"

namespace kaustik::render {

namespace {

// Photons that landed in one pixel. Sums of integers do not depend on their order.
struct PixelCount {
  std::atomic<uint64_t> photons = 0;
  std::array<std::atomic<uint64_t>, 3> colour = {};  // sums of 8-bit values
};

// One for each kind, which people who see few colours can tell apart, too (Okabe and Ito 2008).
constexpr std::array<glm::u8vec3, photon::kPhotonKinds> kKindColours = {
    glm::u8vec3{240, 228, 66}, photon::kShadowColour,      glm::u8vec3{230, 90, 0},
    glm::u8vec3{0, 190, 140},  glm::u8vec3{204, 121, 167}, glm::u8vec3{86, 180, 233}};
constexpr glm::u8vec3 kWhite{255};

// The line of sight to a photon must be free up to this fraction of its length, since the photon's position
// was rounded when it was stored.
constexpr float kNearlyThere = 0.999f;

bool visible(const accel::Bvh& bvh, const Point3& eye, const Point3& p) {
  return !bvh.occluded({eye, p - eye, kNearlyThere});
}

// Mean luminance of the flux, which scales photon_colour(). Summed in a fixed order.
float mean_luminance(const photon::PhotonBuffer& buffer) {
  double sum = 0;
  for (size_t i = 0; i < buffer.records.size(); ++i) sum += luminance(buffer.photon(i).flux);
  return buffer.records.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(buffer.records.size()));
}

void count_photons(const accel::Bvh& bvh, const photon::PlyPhotons& photons, PhotonColours colours,
                   std::vector<PixelCount>& counts) {
  const Camera& camera = bvh.scene().camera;
  const photon::PhotonBuffer& buffer = *photons.buffer;
  const float mean_flux = mean_luminance(buffer);
  parallel::for_range(tbb::blocked_range<size_t>(0, buffer.records.size(), 4096), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const photon::Photon photon = buffer.photon(i);
      Point2 raster;
      Point3 eye;
      if (!camera.project(photon.p, &raster, &eye)) continue;
      if (!visible(bvh, eye, photon.p)) continue;
      const size_t x = std::min(static_cast<size_t>(raster.x), static_cast<size_t>(camera.width - 1));
      const size_t y = std::min(static_cast<size_t>(raster.y), static_cast<size_t>(camera.height - 1));
      PixelCount& pixel = counts[y * static_cast<size_t>(camera.width) + x];
      const glm::u8vec3 colour = colours == PhotonColours::kKind
                                     ? kKindColours[size_t(photons.kind)]
                                     : photon::photon_colour(photons.kind, photon.flux, mean_flux);
      pixel.photons.fetch_add(1, std::memory_order_relaxed);
      for (int c = 0; c < 3; ++c) {
        pixel.colour[static_cast<size_t>(c)].fetch_add(colour[c], std::memory_order_relaxed);
      }
    }
  });
}

// Draws the scene dimly, lit from the eye, so that places can be recognised.
void draw_background(const accel::Bvh& bvh, Image& image) {
  constexpr float kDim = 0.06f;
  const RayGenerator camera(bvh.scene().camera);
  parallel::for_index(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = camera({float(x) + 0.5f, float(y) + 0.5f});
      SurfaceInteraction si;
      if (!bvh.intersect(ray, &si)) continue;
      image.at(x, y) = Rgb(kDim * abs_dot(si.ns, glm::normalize(ray.d)));
    }
  });
}

}  // namespace

std::vector<LegendEntry> legend_of(std::span<const photon::PlyPhotons> photons, PhotonColours colours) {
  std::vector<LegendEntry> entries;
  for (const auto& [kind, buffer] : photons) {
    const bool by_kind = colours == PhotonColours::kKind;
    if (by_kind || kind == photon::PhotonKind::kShadow)
      entries.push_back({by_kind ? kKindColours[size_t(kind)] : photon::kShadowColour,
                         std::string(photon::kPhotonKindNames[size_t(kind)])});
    else if (entries.empty() || entries.front().colour != kWhite)
      entries.insert(entries.begin(), {kWhite, "colour of the light"});
  }
  return entries;
}

Image draw_photons(const accel::Bvh& bvh, std::span<const photon::PlyPhotons> photons,
                   PhotonColours colours) {
  const Camera& camera = bvh.scene().camera;
  Image image(camera.width, camera.height);
  draw_background(bvh, image);
  std::vector<PixelCount> counts(image.pixels.size());
  for (const photon::PlyPhotons& kind : photons) count_photons(bvh, kind, colours, counts);

  uint64_t total = 0, lit = 0;
  for (const PixelCount& pixel : counts) {
    total += pixel.photons;
    lit += pixel.photons > 0 ? 1 : 0;
  }
  // With one photon per lit pixel, a pixel has 86 % of full brightness; in denser pictures one with the mean
  // number has.
  const float scale = total > 0 ? 2.0f * static_cast<float>(lit) / static_cast<float>(total) : 0.0f;
  for (size_t i = 0; i < counts.size(); ++i) {
    const uint64_t n = counts[i].photons;
    if (n == 0) continue;
    const float coverage = 1 - std::exp(-scale * static_cast<float>(n));
    for (int c = 0; c < 3; ++c) {
      const float encoded =
          static_cast<float>(counts[i].colour[static_cast<size_t>(c)]) / (255.0f * float(n));
      image.pixels[i][c] = glm::mix(image.pixels[i][c], linear_from_srgb(encoded), coverage);
    }
  }
  draw_legend(image, legend_of(photons, colours));
  return image;
}

}  // namespace kaustik::render
