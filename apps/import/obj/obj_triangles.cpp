#include "apps/import/obj/obj_triangles.h"

#include <algorithm>

#include "apps/import/ply/polygon.h"
#include "core/parallel/parallel.h"

namespace kaustik::obj {
namespace {

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

class Cutter {
 public:
  Cutter(const ObjText& text, ObjPart& part) : text_(text), part_(part) {}

  void run(const SourceLocation& file) {
    auto change = part_.changes.begin();
    size_t corner = 0;
    for (size_t face = 0; face < part_.sizes.size(); corner += part_.sizes[face++]) {
      for (; change != part_.changes.end() && change->face == face; ++change) change->face = triangles();
      add_face(corner, part_.sizes[face]);
    }
    for (; change != part_.changes.end(); ++change) change->face = triangles();
    part_.corners = std::move(out_);
    part_.sizes = {};
    if (not_finite_ > 0)
      part_.warnings.say(file, "a face with a position that is not finite is left out", not_finite_);
    if (without_area_ > 0) part_.warnings.say(file, "a triangle without area is left out", without_area_);
  }

 private:
  size_t triangles() const { return out_.size() / 3; }

  void add_face(size_t first, size_t size) {
    const Corners& in = part_.corners;
    local_.clear();
    order_.clear();
    const glm::dvec3 origin = text_.P[in.v[first]];
    for (size_t i = first; i < first + size; ++i) {
      if (!finite(text_.P[in.v[i]])) {
        ++not_finite_;
        return;
      }
      local_.emplace_back(text_.P[in.v[i]] - origin);
      order_.push_back(uint32_t(i - first));
    }
    cut_.resize(size - 2);
    pbrt::triangulate(order_, local_, cut_.data());
    for (const auto& triangle : cut_) {
      for (const uint32_t i : triangle) out_.add({in.v[first + i], in.vt_of(first + i), in.vn_of(first + i)});
      if (area_vector(text_, out_, triangles() - 1) == glm::dvec3(0)) out_.drop_triangle(), ++without_area_;
    }
  }

  const ObjText& text_;
  ObjPart& part_;
  Corners out_;
  std::vector<Point3> local_;    // of the face, relative to its first corner
  std::vector<uint32_t> order_;  // 0, 1, 2, ...
  std::vector<std::array<uint32_t, 3>> cut_;
  uint64_t without_area_ = 0, not_finite_ = 0;
};

// Most files are triangles throughout, and stay as they are.
bool is_done(const ObjText& text, const ObjPart& part) {
  if (std::any_of(part.sizes.begin(), part.sizes.end(), [](uint32_t size) { return size != 3; }))
    return false;
  for (size_t i = 0; i < part.sizes.size(); ++i) {
    const glm::dvec3 n = area_vector(text, part.corners, i);
    if (n == glm::dvec3(0) || !finite(n)) return false;
  }
  return true;
}

}  // namespace

glm::dvec3 area_vector(const ObjText& text, const Corners& corners, size_t triangle) {
  const glm::dvec3& a = text.P[corners.v[3 * triangle]];
  return 0.5 * glm::cross(text.P[corners.v[3 * triangle + 1]] - a, text.P[corners.v[3 * triangle + 2]] - a);
}

void cut_into_triangles(ObjText& text, const SourceLocation& file) {
  parallel::for_index(size_t{0}, text.parts.size(), [&](size_t i) {
    ObjPart& part = text.parts[i];
    if (is_done(text, part))
      part.sizes = {};
    else
      Cutter(text, part).run(file);
  });
}

}  // namespace kaustik::obj
