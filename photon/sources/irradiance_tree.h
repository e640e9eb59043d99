#pragma once
// Irradiance of surfaces from few photons, in cells that are smaller where photons are denser.

#include <array>
#include <span>
#include <vector>

#include "core/math/bounds.h"
#include "photon/record/photon.h"

namespace kaustik::photon {

// Six octrees of photons, one for each side of the axes that their surfaces' normals are nearest to, so that
// the two sides of a wall do not share cells. A cell is divided while it holds more than kFullCell photons.
// Immutable; thread-safe. Cells do not change when the scene is scaled by a power of two.
class IrradianceTree {
 public:
  static constexpr size_t kFullCell = 32;

  struct Cell {
    uint64_t photons = 0;
    double flux = 0;  // luminance of their flux
    float side = 1;   // metres
    // As if a plane that is parallel to a face went through the cell, W/m^2.
    float irradiance() const { return float(flux / (double(side) * double(side))); }
    // Photons per m^2, likewise.
    double density() const { return double(photons) / (double(side) * double(side)); }
  };

  IrradianceTree() = default;  // no photons
  IrradianceTree(const std::vector<Photon>& photons, const Bounds3& bounds);

  // The cell of a surface at p with normal n, on that side.
  Cell at(const Point3& p, const Normal3& n) const;

 private:
  static constexpr int kDeepest = 21;
  struct Node {
    uint64_t photons = 0;
    double flux = 0;
    size_t children = 0;  // the first of eight; 0: none
  };
  using Nodes = std::vector<Node>;
  // A node's cell: its middle, and half of its side.
  struct Cube {
    Point3 middle{0};
    float half = 0.5f;

    size_t octant_of(const Point3& p) const {
      return size_t(p.x >= middle.x) | size_t(p.y >= middle.y) << 1 | size_t(p.z >= middle.z) << 2;
    }
    Cube child(size_t octant) const;
  };
  // Writes node `number`, and those below it, from its photons, which it sorts by way of `sorted`.
  static void fill(Nodes& nodes, size_t number, const Cube& cube, int depth, std::span<const Photon*> photons,
                   std::vector<const Photon*>& sorted);

  Cube cube_;
  std::array<Nodes, 6> sides_;
};

}  // namespace kaustik::photon
