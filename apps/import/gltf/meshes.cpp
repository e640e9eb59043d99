#include "apps/import/gltf/meshes.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/common/make_parameter.h"

namespace kaustik::gltf {
namespace {

// Numbers of all meshes of a scene. Many primitives may name the same bytes, so the file size is no bound.
constexpr uint64_t kMostNumbers = uint64_t{1} << 32;

enum class Mode { kTriangles = 4, kStrip = 5, kFan = 6 };

// Converts corners to a list of triangles with three corners each. Every second triangle of a strip winds the
// other way.
std::vector<double> as_triangles(const std::vector<double>& corners, Mode mode) {
  if (mode == Mode::kTriangles) return corners;
  std::vector<double> out;
  for (size_t i = 2; i < corners.size(); ++i) {
    const bool odd = mode == Mode::kStrip && i % 2 == 1;
    const double a = mode == Mode::kFan ? corners[0] : corners[i - 2];
    out.insert(out.end(), {odd ? corners[i - 1] : a, odd ? a : corners[i - 1], corners[i]});
  }
  return out;
}

std::vector<double> corners_of(const Document& document, const View& primitive, uint64_t vertices) {
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
  if (mode == Mode::kTriangles && corners.size() % 3 != 0)
    primitive.fail(fmt::format("has {} corners, which is not a multiple of 3", corners.size()));
  return as_triangles(corners, mode);
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
                                             uint64_t& total) {
  const View attributes = primitive["attributes"];
  const auto accessor = attributes[name].index(document.size("accessors"));
  if (!accessor) return std::nullopt;
  add_numbers(document.item("accessors", *accessor)["count"].count() * static_cast<uint64_t>(components),
              primitive, total);
  Elements e = document.elements(*accessor, components);
  if (e.count != vertices)
    attributes[name].fail(fmt::format("has {} vertices, but the positions have {}", e.count, vertices));
  return std::move(e.values);
}

}  // namespace

std::optional<ShapeDescription> triangles_of(const Document& document, const View& primitive, uint64_t uv_set,
                                             uint64_t& total, FileWarnings& warnings) {
  if (primitive["extensions"].has("KHR_draco_mesh_compression"))
    primitive.fail("is compressed by KHR_draco_mesh_compression, which is not supported");
  const uint64_t mode = primitive["mode"].count(4);
  if (mode > 6) primitive["mode"].fail(fmt::format("is {}, which glTF does not define", mode));
  if (mode < 4) {
    warnings.say("points and lines are ignored: only triangles are rendered");
    return std::nullopt;
  }
  const View position = primitive["attributes"]["POSITION"];
  const auto accessor = position.index(document.size("accessors"));
  if (!accessor) {
    warnings.say("primitives without positions are ignored");
    return std::nullopt;
  }
  const uint64_t vertices = document.item("accessors", *accessor)["count"].count();
  auto P = attribute(document, primitive, "POSITION", 3, vertices, total);
  std::vector<double> corners = corners_of(document, primitive, vertices);
  add_numbers(corners.size(), primitive, total);
  if (corners.empty()) return std::nullopt;
  DirectiveMaker<ShapeDescription> shape("trianglemesh", warnings.where());
  shape.add(ParameterType::kPoint3, "P", std::move(*P));
  shape.add(ParameterType::kInteger, "indices", std::move(corners));
  if (auto N = attribute(document, primitive, "NORMAL", 3, vertices, total))
    shape.add(ParameterType::kNormal, "N", std::move(*N));
  const std::string uv_name = fmt::format("TEXCOORD_{}", uv_set);
  if (auto uv = attribute(document, primitive, uv_name.c_str(), 2, vertices, total)) {
    for (size_t i = 1; i < uv->size(); i += 2) (*uv)[i] = 1 - (*uv)[i];
    shape.add(ParameterType::kPoint2, "uv", std::move(*uv));
  }
  return std::move(*shape);
}

glm::dvec3 mean_vertex_colour(const Document& document, const View& primitive, FileWarnings& warnings) {
  const auto accessor = primitive["attributes"]["COLOR_0"].index(document.size("accessors"));
  if (!accessor) return glm::dvec3(1);
  const bool with_alpha = document.item("accessors", *accessor)["type"].text() == "VEC4";
  const size_t n = with_alpha ? 4 : 3;
  const std::vector<double> c = document.elements(*accessor, static_cast<int>(n)).values;
  glm::dvec3 sum(0);
  bool differ = false;
  for (size_t i = 0; i + n <= c.size(); i += n) {
    sum += glm::dvec3(c[i], c[i + 1], c[i + 2]);
    differ = differ || !std::equal(c.begin(), c.begin() + 3, c.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (differ) warnings.say("vertex colours are replaced by their mean over the mesh");
  return c.empty() ? glm::dvec3(1) : glm::clamp(sum / (double(c.size()) / double(n)), 0.0, 1.0);
}

}  // namespace kaustik::gltf
