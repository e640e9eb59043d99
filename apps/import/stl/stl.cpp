#include "apps/import/stl/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <unordered_map>

#include "apps/import/common/scene_files.h"
#include "apps/import/obj/obj_text.h"
#include "core/files/content_hash.h"
#include "core/math/hash.h"
#include "core/text.h"

namespace kaustik {
namespace {

constexpr uint64_t kLargestStl = uint64_t{1} << 38;
constexpr size_t kStlHeader = 84, kStlFacet = 50;  // bytes

struct PointHash {
  size_t operator()(const Point3& p) const {
    const auto bits = [](float v) { return uint64_t{std::bit_cast<uint32_t>(v + 0.0f)}; };  // -0 is 0
    return hash_combine(bits(p.x) << 32 | bits(p.y), bits(p.z));
  }
};

class StlMesh {
 public:
  void add(const std::array<Point3, 3>& corners) {
    for (const Point3& p : corners)
      if (!is_finite(p)) return;
    std::array<uint32_t, 3> triangle{};
    for (size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = vertices_.try_emplace(corners[k], uint32_t(mesh_.P.size()));
      if (is_new) mesh_.P.push_back(corners[k]);
      triangle[k] = at->second;
    }
    mesh_.indices.push_back(triangle);
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  TriangleMesh mesh_;
  std::unordered_map<Point3, uint32_t, PointHash> vertices_;
};

uint64_t facets_of(std::string_view bytes) {
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kStlHeader - sizeof count, sizeof count);
  return count;
}

// ASCII files begin with `solid`, but so do the headers of some binary ones.
bool is_ascii(std::string_view bytes) {
  const std::string_view front = bytes.substr(0, 1024);
  return front.starts_with("solid") &&
         (front.find("facet") != front.npos || front.find("endsolid") != front.npos);
}

MeshResult read_binary(std::string_view bytes) {
  if (bytes.size() < kStlHeader) return {{}, "the file ends within its header"};
  const uint64_t facets = facets_of(bytes), there = (bytes.size() - kStlHeader) / kStlFacet;
  if (facets > there) return {{}, fmt::format("the file promises {} facets, but has {}", facets, there)};
  StlMesh mesh;
  for (uint64_t i = 0; i < facets; ++i) {
    std::array<Point3, 3> corners;
    // A normal of 12 bytes precedes the corners.
    std::memcpy(corners.data(), bytes.data() + kStlHeader + kStlFacet * i + 12, sizeof corners);
    mesh.add(corners);
  }
  return {mesh.take(), {}};
}

MeshResult read_ascii(std::string_view text) {
  StlMesh mesh;
  std::array<Point3, 3> corners;
  size_t count = 0;
  for (uint64_t line = 1; !text.empty(); ++line) {
    const size_t end = text.find('\n');
    obj::Words words(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    const std::string keyword = lower_case(words.next());
    if (keyword == "facet" || keyword == "outer") count = 0;
    if (keyword != "vertex") continue;
    Point3& p = corners[count++ % 3];
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = words.next();
      const auto value = obj::number_of(word);
      if (!value) return {{}, fmt::format("line {}: `{}` is not a number", line, word.substr(0, 40))};
      p[k] = float(*value);
    }
    if (count % 3 == 0) mesh.add(corners);
  }
  return {mesh.take(), {}};
}

}  // namespace

MeshResult load_stl(const ReadableFile& file, std::string* content) {
  std::string error;
  const auto bytes = pbrt::read_bytes(file, kLargestStl, error);
  if (!bytes) return {{}, std::move(error)};
  ContentHash hash;
  hash.add(*bytes);
  if (content) *content = hash.text();
  MeshResult result = is_ascii(*bytes) ? read_ascii(*bytes) : read_binary(*bytes);
  if (!result.error.empty())
    result.error = fmt::format("cannot read \"{}\": {}", file.path().string(), result.error);
  return result;
}

}  // namespace kaustik
