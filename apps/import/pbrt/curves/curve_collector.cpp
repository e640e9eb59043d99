#include "apps/import/pbrt/curves/curve_collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/import/common/make_parameter.h"

namespace kaustik::pbrt {
namespace {

// Tubes of a few curves are seen closely; those of hair are thinner than a pixel and many.
TubeDetail detail_for(size_t segments) {
  constexpr size_t kFew = 5'000, kMany = 100'000;
  if (segments <= kFew) return {12, 0.1, 64};
  return segments <= kMany ? TubeDetail{5, 0.5, 16} : TubeDetail{3, 1, 4};
}

double number(const Directive& d, std::string_view name, double otherwise) {
  const Parameter* p = d.find(name);
  return p && p->numbers.size() == 1 ? p->numbers[0] : otherwise;
}

std::string text(const Directive& d, std::string_view name, std::string otherwise) {
  const Parameter* p = d.find(name);
  return p && p->strings.size() == 1 ? p->strings[0] : otherwise;
}

std::vector<glm::dvec3> points(const Parameter* p) {
  std::vector<glm::dvec3> out(p ? p->numbers.size() / 3 : 0);
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = {p->numbers[3 * i], p->numbers[3 * i + 1], p->numbers[3 * i + 2]};
  return out;
}

// Sets the control points of segment i as those of a cubic Bezier curve.
void set_points(CurveSegment& s, const std::vector<glm::dvec3>& P, size_t i, bool spline, size_t degree) {
  const glm::dvec3* p = &P[spline ? i : i * degree];
  if (degree == 2) {
    const glm::dvec3 first = spline ? 0.5 * (p[0] + p[1]) : p[0], last = spline ? 0.5 * (p[1] + p[2]) : p[2];
    s.P[0] = first, s.P[1] = (first + 2.0 * p[1]) / 3.0, s.P[2] = (2.0 * p[1] + last) / 3.0, s.P[3] = last;
  } else if (spline) {
    s.P[0] = (p[0] + 4.0 * p[1] + p[2]) / 6.0, s.P[1] = (2.0 * p[1] + p[2]) / 3.0;
    s.P[2] = (p[1] + 2.0 * p[2]) / 3.0, s.P[3] = (p[1] + 4.0 * p[2] + p[3]) / 6.0;
  } else {
    std::copy_n(p, 4, s.P);
  }
}

bool same_surface(const ShapeDescription& a, const ShapeDescription& b) {
  return a.material.index == b.material.index && a.material.name == b.material.name &&
         a.area_light == b.area_light && a.reverse_orientation == b.reverse_orientation;
}

}  // namespace

CurveCollector::Group& CurveCollector::group_of(const ShapeDescription& curve, std::optional<size_t> object) {
  const auto fits = [&](const Group& g) { return g.object == object && same_surface(g.shape, curve); };
  if (last_ < groups_.size() && fits(groups_[last_])) return groups_[last_];
  last_ = static_cast<size_t>(std::find_if(groups_.begin(), groups_.end(), fits) - groups_.begin());
  if (last_ < groups_.size()) return groups_[last_];
  Group& group = groups_.emplace_back();
  group.object = object;
  group.shape = curve;
  group.shape.type = "trianglemesh";
  group.shape.object_to_world = glm::dmat4(1);
  std::erase_if(group.shape.parameters,
                [](const Parameter& p) { return p.name != "alpha" && p.name != "surfacegroup"; });
  return group;
}

void CurveCollector::add(const ShapeDescription& curve, std::optional<size_t> object) {
  const bool spline = text(curve, "basis", "bezier") == "bspline",
             ribbon = text(curve, "type", "flat") == "ribbon";
  const size_t degree = number(curve, "degree", 3) == 2 ? 2 : 3;
  std::vector<glm::dvec3> P = points(curve.find("P"));
  const glm::dmat4& m = curve.object_to_world;
  for (glm::dvec3& p : P) p = glm::dvec3(m * glm::dvec4(p, 1));
  const bool finite =
      std::all_of(P.begin(), P.end(), [](const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); });
  const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(m))));
  if (P.size() <= degree || !finite || !(scale > 0)) {
    return warnings_.say_one_of(
        "curve", curve.location,
        fmt::format("a curve takes {} finite points or more: this one is left out", degree + 1));
  }
  const size_t count = spline ? P.size() - degree : (P.size() - 1) / degree;
  const std::vector<glm::dvec3> N = ribbon ? points(curve.find("N")) : std::vector<glm::dvec3>{};
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
  const double width = number(curve, "width", 1);
  const double first = number(curve, "width0", width), last = number(curve, "width1", width);
  Group& group = group_of(curve, object);
  for (size_t i = 0; i < count; ++i) {
    CurveSegment& s = group.segments.emplace_back();
    set_points(s, P, i, spline, degree);
    s.width0 = scale * std::max(0.0, std::lerp(first, last, double(i) / double(count)));
    s.width1 = scale * std::max(0.0, std::lerp(first, last, double(i + 1) / double(count)));
    s.continues = i > 0;
    if (N.size() <= count) continue;
    s.n0 = glm::vec3(normal_matrix * N[i]);
    s.n1 = glm::vec3(normal_matrix * N[i + 1]);
  }
}

void CurveCollector::finish(SceneDescription& scene) {
  size_t segments = 0;
  for (const Group& g : groups_) segments += g.segments.size();
  for (Group& g : groups_) {
    TubeMesh mesh = tubes_of(g.segments, detail_for(segments));
    g.segments = {};
    const SourceLocation& where = g.shape.location;
    g.shape.parameters.push_back(make_parameter(ParameterType::kPoint3, "P", std::move(mesh.P), where));
    g.shape.parameters.push_back(make_parameter(ParameterType::kNormal, "N", std::move(mesh.N), where));
    g.shape.parameters.push_back(
        make_parameter(ParameterType::kInteger, "indices", std::move(mesh.indices), where));
    (g.object ? scene.objects[*g.object].shapes : scene.shapes).push_back(std::move(g.shape));
  }
  groups_.clear();
}

}  // namespace kaustik::pbrt
