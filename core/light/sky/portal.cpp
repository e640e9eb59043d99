// Resampling of a sky over the directions through a portal, and its sampling.

#include "core/light/sky/portal.h"

namespace kaustik {
namespace {

constexpr int kFewestCells = 64;  // per side, so that a sky of one colour follows the solid angle
constexpr int kMostCells = 2048;
constexpr int kSamplesPerCell = 3;  // per side

Point2 cell_middle(int x, int y, int resolution) {
  return (Point2(x, y) + 0.5f) / static_cast<float>(resolution);
}

}  // namespace

Point2 PortalSky::square_of(const Vector3& w) {
  return {0.5f + kInvPi * std::atan2(w.x, w.z), 0.5f + kInvPi * std::atan2(w.y, w.z)};
}

// With x = tan alpha and y = tan beta on the plane z = 1, dw = dx dy / (1 + x^2 + y^2)^(3/2) and dx = (1 +
// x^2) dalpha.
Vector3 PortalSky::direction_of(const Point2& p, float* solid_angle) {
  const auto tangent = [](float s) { return std::tan(kPi * (std::clamp(s, 1e-6f, 1 - 1e-6f) - 0.5f)); };
  const Vector3 w(tangent(p.x), tangent(p.y), 1);
  const float length = glm::length(w);
  *solid_angle = kPi * kPi * ((1 + w.x * w.x) / length) * ((1 + w.y * w.y) / length) / length;
  return w / length;
}

PortalSky::PortalSky(const DirectionMap& map, const glm::mat3& to_map)
    : resolution_(std::clamp(map.rows(), kFewestCells, kMostCells)) {
  const int samples = kSamplesPerCell * resolution_;
  cells_.reserve(static_cast<size_t>(resolution_) * static_cast<size_t>(resolution_));
  for (int y = 0; y < samples; y += kSamplesPerCell) {
    for (int x = 0; x < samples; x += kSamplesPerCell) {
      Rgb sum(0);
      for (int s = 0; s < kSamplesPerCell * kSamplesPerCell; ++s) {
        float ignored;
        const Point2 at = cell_middle(x + s % kSamplesPerCell, y + s / kSamplesPerCell, samples);
        sum += map.value(to_map * direction_of(at, &ignored));
      }
      cells_.push_back(sum / static_cast<float>(kSamplesPerCell * kSamplesPerCell));
    }
  }
  prepare();
}

PortalSky::PortalSky(const Rgb& L)
    : resolution_(kFewestCells), cells_(size_t{kFewestCells} * kFewestCells, L) {
  prepare();
}

void PortalSky::prepare() {
  const auto weight = [&](int x, int y, double* cosine) {
    float solid_angle;
    const Vector3 w = direction_of(cell_middle(x, y, resolution_), &solid_angle);
    *cosine = static_cast<double>(w.z);
    return static_cast<double>(solid_angle);
  };
  glm::dvec3 sum(0);
  seen_ = WindowedPiecewiseConstant2D(resolution_, resolution_, [&](int x, int y) {
    double cosine;
    return weight(x, y, &cosine) * static_cast<double>(luminance(value(cell_middle(x, y, resolution_))));
  });
  photons_ = PiecewiseConstant2D(resolution_, resolution_, [&](int x, int y) {
    double cosine;
    const Rgb& L = value(cell_middle(x, y, resolution_));
    const double projected = weight(x, y, &cosine) * cosine;
    sum += projected * glm::dvec3(L);
    brightest_ = glm::max(brightest_, L);
    return projected * static_cast<double>(luminance(L));
  });
  irradiance_ = Rgb(sum / static_cast<double>(resolution_) / static_cast<double>(resolution_));
}

Rgb PortalSky::value(const Point2& p) const {
  const auto cell = [&](float s) {
    return static_cast<size_t>(
        std::clamp(static_cast<int>(s * static_cast<float>(resolution_)), 0, resolution_ - 1));
  };
  return cells_[cell(p.y) * static_cast<size_t>(resolution_) + cell(p.x)];
}

std::optional<PortalSky::Photon> PortalSky::sample_photon(const Point2& u) const {
  const PiecewiseConstant2D::Sample s = photons_.sample(u);
  const float n = static_cast<float>(resolution_);
  float solid_angle;
  const Vector3 w = direction_of((Point2(s.x, s.y) + s.in_cell) / n, &solid_angle);
  const Rgb L =
      cells_[static_cast<size_t>(s.y) * static_cast<size_t>(resolution_) + static_cast<size_t>(s.x)];
  if (is_black(L)) return std::nullopt;
  return Photon{w, L * (w.z * solid_angle / (s.probability * n * n))};
}

std::optional<Window> PortalInfiniteLight::window_from(const Point3& p) const {
  const Vector3 near = (corner - p) * to_world, far = (corner + along_x + along_y - p) * to_world;
  if (!(near.z > 0 && far.z > 0)) return std::nullopt;
  const Point2 a = PortalSky::square_of(near), b = PortalSky::square_of(far);
  return Window{glm::min(a, b), glm::max(a, b)};
}

Rgb PortalInfiniteLight::Le(const Ray& escaping) const {
  const Vector3 w = escaping.d * to_world;
  if (!(w.z > 0)) return Rgb(0);
  const auto window = window_from(escaping.o);
  const Point2 p = PortalSky::square_of(w);
  return window && window->contains(p) ? scale * sky->value(p) : Rgb(0);
}

std::optional<LightSample> PortalInfiniteLight::sample_Li(const Point3& ref, const Point2& u) const {
  const auto window = window_from(ref);
  const auto s = window ? sky->seen().sample(*window, u) : std::nullopt;
  if (!s) return std::nullopt;
  float solid_angle;
  const Vector3 w = PortalSky::direction_of(s->p, &solid_angle);
  return LightSample{to_world * w, scale * sky->value(s->p), s->pdf / solid_angle, Point3(0), true};
}

float PortalInfiniteLight::pdf_Li(const Point3& ref, const Vector3& wi) const {
  const Vector3 w = wi * to_world;
  const auto window = w.z > 0 ? window_from(ref) : std::nullopt;
  if (!window) return 0;
  const Point2 p = PortalSky::square_of(w);
  float solid_angle;
  PortalSky::direction_of(p, &solid_angle);
  return sky->seen().pdf(*window, p) / solid_angle;
}

std::optional<EmissionSample> PortalInfiniteLight::sample_Le(const Point2& u_pos, const Point2& u_dir,
                                                             EmissionMode /*mode*/) const {
  const auto photon = sky->sample_photon(u_dir);
  if (!photon) return std::nullopt;
  const float area = glm::length(along_x) * glm::length(along_y);
  return EmissionSample{{corner + u_pos.x * along_x + u_pos.y * along_y, -(to_world * photon->w)},
                        area * (scale * photon->flux),
                        true};
}

Rgb PortalInfiniteLight::power() const {
  return glm::length(along_x) * glm::length(along_y) * (scale * sky->irradiance());
}

}  // namespace kaustik
