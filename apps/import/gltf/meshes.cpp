#include "apps/import/gltf/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/import/common/make_parameter.h"

namespace kaustik::gltf {
namespace {

// Numbers of all meshes of a scene. Many primitives may name the same bytes, so the file size is no bound.
constexpr uint64_t kMostNumbers = uint64_t{1} << 32;

enum class Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

// Converts corners to a list of triangles with three corners each. Every second triangle of a strip winds the
// other way.
std::vector<double> as_triangles(std::vector<double> corners, Mode mode) {
  if (mode == Mode::kTriangles) return corners;
  std::vector<double> out;
  for (size_t i = 2; i < corners.size(); ++i) {
    const bool odd = mode == Mode::kStrip && i % 2 == 1;
    const double a = mode == Mode::kFan ? corners[0] : corners[i - 2];
    out.insert(out.end(), {odd ? corners[i - 1] : a, odd ? a : corners[i - 1], corners[i]});
  }
  return out;
}

std::vector<double> corners_of(const Document& document, const View& primitive, uint64_t vertices,
                               FileWarnings& warnings) {
  const auto accessor = primitive["indices"].index(document.size("accessors"));
  std::vector<double> corners;
  if (accessor) {
    corners = document.elements(*accessor, 1).values;
    for (size_t i = 0; i < corners.size(); ++i) {
      if (!(corners[i] >= 0 && corners[i] < double(vertices)))
        primitive["indices"].fail(fmt::format("names vertex {}, but there are {}", corners[i], vertices));
    }
  } else {
    for (uint64_t i = 0; i < vertices; ++i) corners.push_back(double(i));
  }
  const auto mode = static_cast<Mode>(primitive["mode"].count(4));
  if (mode == Mode::kTriangles && corners.size() % 3 != 0) {
    warnings.count("triangles of fewer than three corners are left out", "primitive");
    corners.resize(corners.size() / 3 * 3);
  }
  return as_triangles(std::move(corners), mode);
}

void add_numbers(uint64_t n, const View& primitive, uint64_t& total) {
  total += n;
  if (total > kMostNumbers)
    primitive.fail(fmt::format("makes the scene larger than {} numbers", kMostNumbers));
}

// Reads a vertex attribute; nothing when it is absent. Throws unless it has as many elements as there are
// vertices.
std::optional<std::vector<double>> attribute(const Document& document, const View& primitive,
                                             const char* name, int components, uint64_t vertices,
                                             uint64_t& total, FileWarnings& warnings) {
  const View attributes = primitive["attributes"];
  const auto accessor = attributes[name].index(document.size("accessors"));
  if (!accessor) return std::nullopt;
  add_numbers(document.count(*accessor) * static_cast<uint64_t>(components), primitive, total);
  const bool position = std::string_view(name) == "POSITION";
  Elements e = document.elements(*accessor, components, !position);
  if (e.count != vertices)
    attributes[name].fail(fmt::format("has {} vertices, but the positions have {}", e.count, vertices));
  const auto bad = [](double v) { return !std::isfinite(v); };
  if (std::any_of(e.values.begin(), e.values.end(), bad)) {
    warnings.count(fmt::format("numbers of {} that are not finite are taken for 0", name), "primitive");
    std::replace_if(e.values.begin(), e.values.end(), bad, 0.0);
  }
  return std::move(e.values);
}

}  // namespace

bool has_triangles(const View& primitive, FileWarnings& warnings) {
  const uint64_t mode = primitive["mode"].count(4);
  if (mode > 6) primitive["mode"].fail(fmt::format("is {}, which glTF does not define", mode));
  if (mode < 4) warnings.count("points and lines are left out: only triangles are rendered", "primitive");
  return mode >= 4;
}

std::optional<ShapeDescription> triangles_of(const Document& document, const View& primitive,
                                             const UvSource& source, uint64_t& total,
                                             FileWarnings& warnings) {
  const View position = primitive["attributes"]["POSITION"];
  const auto accessor = position.index(document.size("accessors"));
  if (!accessor) {
    warnings.count("meshes without positions are left out", "primitive");
    return std::nullopt;
  }
  const uint64_t vertices = document.count(*accessor);
  auto P = attribute(document, primitive, "POSITION", 3, vertices, total, warnings);
  std::vector<double> corners = corners_of(document, primitive, vertices, warnings);
  add_numbers(corners.size(), primitive, total);
  if (corners.empty()) return std::nullopt;
  DirectiveMaker<ShapeDescription> shape("trianglemesh", warnings.where());
  shape.add(ParameterType::kPoint3, "P", std::move(*P));
  shape.add(ParameterType::kInteger, "indices", std::move(corners));
  if (auto N = attribute(document, primitive, "NORMAL", 3, vertices, total, warnings))
    shape.add(ParameterType::kNormal, "N", std::move(*N));
  const std::string uv_name = fmt::format("TEXCOORD_{}", source.set);
  if (auto uv = attribute(document, primitive, uv_name.c_str(), 2, vertices, total, warnings)) {
    for (size_t i = 0; i < uv->size(); i += 2) {
      const glm::dvec3 at = source.transform * glm::dvec3((*uv)[i], (*uv)[i + 1], 1);
      (*uv)[i] = at.x, (*uv)[i + 1] = 1 - at.y;
    }
    shape.add(ParameterType::kPoint2, "uv", std::move(*uv));
  }
  return std::move(*shape);
}

VertexColours vertex_colours(const Document& document, const View& primitive, uint64_t& total) {
  const auto accessor = primitive["attributes"]["COLOR_0"].index(document.size("accessors"));
  if (!accessor) return {};
  const int n = document.components(*accessor);
  if (n != 3 && n != 4) primitive["attributes"]["COLOR_0"].fail("is no colour of three or four numbers");
  add_numbers(4 * document.count(*accessor), primitive, total);
  const std::vector<double> c = document.elements(*accessor, n, true).values;
  VertexColours colours;
  bool differ = false;
  for (size_t i = 0; i < c.size(); i += static_cast<size_t>(n)) {
    for (size_t k = 0; k < 4; ++k) {
      const double v = k < static_cast<size_t>(n) ? c[i + k] : 1;
      colours.each.push_back(std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : 1);
      differ = differ || colours.each.back() != colours.each[k];
    }
  }
  if (differ) return colours;
  for (size_t k = 0; k < 4 && !colours.each.empty(); ++k)
    colours.common[static_cast<int>(k)] = colours.each[k];
  colours.each.clear();
  return colours;
}

}  // namespace kaustik::gltf
