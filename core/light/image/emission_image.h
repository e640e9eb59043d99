#pragma once
// Images on area lights, and the sampling of points by what they emit.

#include <array>
#include <memory>
#include <vector>

#include "core/geometry/interaction.h"
#include "core/light/image/light_image.h"
#include "core/sampling/discrete.h"
#include "core/sampling/piecewise_2d.h"

namespace kaustik {

// The image that a textured area light emits, over the uv of its surface: interpolated bilinearly between
// pixels and clamped at the edges, with (0, 0) the lower left corner, as in pbrt-v4. Also samples points of
// the surface in proportion to luminance: first a part (a triangle, or the whole quadric) by its power, then
// a cell of a table over the unit square, which is mapped to the part with uniform area. Cells are about half
// a pixel wide, with at most 2^19 of them in total. One sample in 32 is spread evenly over the surface, so
// that no emitting point is missed and weights are bounded. Immutable; thread-safe.
class EmissionImage {
 public:
  // A triangle of the emitting mesh, with the uv of its corners, in the order of the mesh.
  struct Triangle {
    double area;  // m^2
    std::array<Point2, 3> uv;
  };
  EmissionImage(std::shared_ptr<const LightImage> image, std::vector<Triangle> triangles);
  // For a whole sphere, cylinder or disk, or a part of one; area in m^2.
  EmissionImage(std::shared_ptr<const LightImage> image, const SweptGeometry& shape, double area);

  // A point on the surface: the triangle (zero for quadrics), and the point of the square that
  // sample_uniform_triangle() or sample_uniform() maps to the surface.
  struct Place {
    uint32_t part = 0;
    Point2 u{0};
  };
  struct Sample {
    Place place;
    float area;  // m^2: one over the density
  };
  // u in [0, 1)^2.
  Sample sample(const Point2& u) const;
  float area(const Place& place) const;  // as in Sample
  Place place_of(const SurfaceInteraction& on_surface) const;

  Point2 uv(const Place& place) const;
  Rgb value(const Point2& uv) const;
  Rgb mean() const { return mean_; }              // over the surface
  Rgb mean_of_pixels() const { return pixels_; }  // including pixels that the surface does not show
  Rgb brightest() const { return brightest_; }    // maximum of all pixels, per channel

 private:
  // Root mean square luminance of each cell of a part's table, row by row, and the mean of these numbers.
  struct Cells {
    int n = 1;
    std::vector<double> luminance;
    double mean = 0;
  };
  void summarise_pixels();
  void make_tables(const std::vector<double>& areas);
  std::vector<int> resolutions() const;
  int wanted_resolution(const Triangle& triangle) const;
  Cells cells_of(uint32_t part, int n, glm::dvec3* mean) const;

  std::shared_ptr<const LightImage> image_;
  std::vector<Triangle> triangles_;  // empty for a quadric
  SweptGeometry shape_;
  DiscreteDistribution parts_;
  std::vector<PiecewiseConstant2D> tables_;  // one per part; empty for a part with a single cell
  std::vector<float> areas_;                 // area of each part over its probability
  Rgb mean_{0}, pixels_{0}, brightest_{0};
};

}  // namespace kaustik
