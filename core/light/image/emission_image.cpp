// Tables for the sampling of textured area lights.

#include "core/light/image/emission_image.h"

#include "core/sampling/warp.h"

namespace kaustik {
namespace {

constexpr double kMostCells = 1 << 19;
constexpr int kMostPerSide = 512;
constexpr double kEvenShare = 1.0 / 32;
// Points per side of a cell at which its luminance is measured: eight per pixel where the resolution permits.
// (Of all densities that are constant over a cell, the one proportional to the root mean square has the least
// variance.)
constexpr int kPoints = 4;

// Inverse of sample_uniform_triangle(): the point of the square that maps to barycentrics b.
Point2 square_of_barycentrics(const Point2& b) {
  const float smaller = 2 * std::min(b.x, b.y), larger = b.x + b.y;
  return b.x < b.y ? Point2(smaller, larger) : Point2(larger, smaller);
}

}  // namespace

EmissionImage::EmissionImage(std::shared_ptr<const LightImage> image, std::vector<Triangle> triangles)
    : image_(std::move(image)), triangles_(std::move(triangles)) {
  std::vector<double> areas;
  for (const Triangle& t : triangles_) areas.push_back(t.area);
  make_tables(areas);
}

EmissionImage::EmissionImage(std::shared_ptr<const LightImage> image, const SweptGeometry& shape, double area)
    : image_(std::move(image)), shape_(shape) {
  make_tables({area});
}

Rgb EmissionImage::value(const Point2& uv) const {
  // NaN is mapped to the first pixel.
  const auto at = [](float s, int n) {
    return std::min(std::max(0.0f, s * static_cast<float>(n) - 0.5f), static_cast<float>(n - 1));
  };
  const float x = at(uv.x, image_->width), y = at(1 - uv.y, image_->height);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image_->width - 1), y1 = std::min(y0 + 1, image_->height - 1);
  const float dx = x - static_cast<float>(x0), dy = y - static_cast<float>(y0);
  return (1 - dy) * ((1 - dx) * image_->at(x0, y0) + dx * image_->at(x1, y0)) +
         dy * ((1 - dx) * image_->at(x0, y1) + dx * image_->at(x1, y1));
}

Point2 EmissionImage::uv(const Place& place) const {
  if (triangles_.empty()) {
    const float u_x = place.u.x;
    return {place.u.y, std::visit([&](const auto& shape) { return shape.v_of(u_x); }, shape_)};
  }
  const Point2 b = sample_uniform_triangle(place.u);
  const auto& uv = triangles_[place.part].uv;
  return uv[0] + (b.x * (uv[1] - uv[0]) + b.y * (uv[2] - uv[0]));
}

EmissionImage::Place EmissionImage::place_of(const SurfaceInteraction& on_surface) const {
  if (!triangles_.empty()) return {on_surface.primitive, square_of_barycentrics(on_surface.hit_uv)};
  const auto square = [&](const auto& shape) {
    return shape.square_of(local_point(shape, on_surface.p, on_surface.hit_uv));
  };
  return {0, std::visit(square, shape_)};
}

EmissionImage::Sample EmissionImage::sample(const Point2& u) const {
  const DiscreteDistribution::Sample part = parts_.sample(u.x);
  Sample s{{part.index, {part.u_remapped, u.y}}, areas_[part.index]};
  const PiecewiseConstant2D& table = tables_[part.index];
  const int n = table.width();
  if (n == 0) return s;
  const PiecewiseConstant2D::Sample cell = table.sample(s.place.u);
  s.place.u = (Point2(cell.x, cell.y) + cell.in_cell) / static_cast<float>(n);
  s.area /= cell.probability * static_cast<float>(n * n);
  return s;
}

float EmissionImage::area(const Place& place) const {
  const PiecewiseConstant2D& table = tables_[place.part];
  const int n = table.width();
  if (n == 0) return areas_[place.part];
  const float cell = table.probability(cell_of(place.u.x, n), cell_of(place.u.y, n));
  return areas_[place.part] / (cell * static_cast<float>(n * n));
}

void EmissionImage::summarise_pixels() {
  glm::dvec3 sum(0);
  for (const Rgb& c : image_->pixels) {
    sum += glm::dvec3(c);
    brightest_ = glm::max(brightest_, c);
  }
  pixels_ = Rgb(sum / static_cast<double>(image_->pixels.size()));
}

// Two cells per pixel along the longer side of the triangle in the image.
int EmissionImage::wanted_resolution(const Triangle& t) const {
  const Point2 extent =
      glm::max(t.uv[0], glm::max(t.uv[1], t.uv[2])) - glm::min(t.uv[0], glm::min(t.uv[1], t.uv[2]));
  const double pixels = std::max(double(extent.x) * image_->width, double(extent.y) * image_->height);
  // NaN gives one cell.
  return pixels > 0 ? static_cast<int>(std::ceil(std::min(2 * pixels, double{kMostPerSide}))) : 1;
}

std::vector<int> EmissionImage::resolutions() const {
  if (triangles_.empty()) return {std::clamp(2 * std::max(image_->width, image_->height), 1, kMostPerSide)};
  std::vector<int> n;
  double cells = 0;
  for (const Triangle& t : triangles_) {
    n.push_back(wanted_resolution(t));
    cells += double(n.back()) * n.back();
  }
  const double shrink = std::sqrt(std::min(1.0, kMostCells / cells));
  for (int& side : n) side = std::max(1, static_cast<int>(shrink * side));
  return n;
}

EmissionImage::Cells EmissionImage::cells_of(uint32_t part, int n, glm::dvec3* mean) const {
  Cells cells{n, {}, 0};
  glm::dvec3 sum(0);
  const float step = 1 / static_cast<float>(kPoints * n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      glm::dvec3 in_cell(0);
      double squares = 0;
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const Point2 at(static_cast<float>(kPoints * x + k % kPoints) + 0.5f,
                        static_cast<float>(kPoints * y + k / kPoints) + 0.5f);
        const Rgb colour = value(uv({part, step * at}));
        in_cell += glm::dvec3(colour);
        squares += double(luminance(colour)) * double(luminance(colour));
      }
      sum += in_cell / double{kPoints * kPoints};
      cells.luminance.push_back(std::sqrt(squares / double{kPoints * kPoints}));
      cells.mean += cells.luminance.back() / (double(n) * n);
    }
  }
  *mean = sum / (double(n) * n);
  return cells;
}

void EmissionImage::make_tables(const std::vector<double>& areas) {
  summarise_pixels();
  const std::vector<int> n = resolutions();
  std::vector<Cells> cells;
  glm::dvec3 power(0);
  double whole = 0;
  for (uint32_t i = 0; i < areas.size(); ++i) {
    glm::dvec3 mean;
    cells.push_back(cells_of(i, n[i], &mean));
    power += areas[i] * mean;
    whole += areas[i];
  }
  mean_ = Rgb(power / whole);
  const double even = luminance(mean_) > 0 ? kEvenShare * double(luminance(mean_)) : 1;
  std::vector<double> weights;
  for (size_t i = 0; i < areas.size(); ++i) weights.push_back(areas[i] * (cells[i].mean + even));
  parts_ = DiscreteDistribution(weights);
  tables_.resize(areas.size());
  for (uint32_t i = 0; i < areas.size(); ++i) {
    areas_.push_back(static_cast<float>(areas[i] * parts_.total() / weights[i]));
    if (n[i] == 1) continue;
    tables_[i] = PiecewiseConstant2D(n[i], n[i], [&](int x, int y) {
      return cells[i].luminance[size_t(y) * size_t(n[i]) + size_t(x)] + even;
    });
  }
}

}  // namespace kaustik
