#include "apps/import/ply/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "apps/import/common/gzip.h"
#include "apps/import/common/scene_files.h"
#include "apps/import/ply/ply_body.h"
#include "apps/import/ply/polygon.h"
#include "core/files/content_hash.h"
#include "core/parallel/parallel.h"
#include "core/spectrum/srgb.h"

namespace kaustik::pbrt {
namespace {

constexpr uint64_t kLargestMeshFile = uint64_t{1} << 38;

// pbrt's default uv for meshes without texture coordinates: (0, 0), (1, 0), (1, 1) for a triangle, and (0, 1)
// for the fourth corner of a quad. They are usable only if no two faces share a corner. add() is thread-safe.
class BareFaces {
 public:
  explicit BareFaces(size_t vertices) : uv_(vertices), taken_(vertices) {}

  void add(std::span<const uint32_t> corners) {
    static const std::array<Point2, 4> kUv{Point2(0, 0), Point2(1, 0), Point2(1, 1), Point2(0, 1)};
    bool kept = corners.size() <= kUv.size();
    for (size_t i = 0; kept && i < corners.size(); ++i) {
      kept = !taken_[corners[i]].exchange(true, std::memory_order_relaxed);
      if (kept) uv_[corners[i]] = kUv[i];
    }
    if (!kept) shared_.store(true, std::memory_order_relaxed);
  }
  std::vector<Point2> take() { return shared_ ? std::vector<Point2>() : std::move(uv_); }

 private:
  std::vector<Point2> uv_;
  std::vector<std::atomic<bool>> taken_;
  std::atomic<bool> shared_ = false;
};

// Colours of whole numbers are encoded in sRGB, but not alpha; floats are linear. Not a number becomes 1.
float linear_colour(double value, PlyType type, bool alpha) {
  if (is_integer(type)) value /= size_of(type) == 1 ? 255 : 65535;
  if (!(value >= 0)) return value < 0 ? 0.0f : 1.0f;
  if (is_integer(type) && !alpha) value = linear_from_srgb(value);
  return static_cast<float>(std::min(value, 1.0));
}

class MeshReader {
 public:
  MeshReader(std::string_view bytes, const PlyHeader& header, bool colours)
      : bytes_(bytes), header_(header), colours_(colours) {}

  MeshResult read() {
    std::vector<PlyExtent> extents;
    for (size_t e = 0, begin = header_.body; e < header_.elements.size(); ++e) {
      auto extent = walk_ply(bytes_, header_, e, begin, error_);
      if (!extent) return {{}, std::move(error_)};
      begin = extent->end;
      extents.push_back(std::move(*extent));
    }
    if (read_vertices(extents[header_.vertex]) && read_faces(extents[header_.face]))
      return {std::move(mesh_), {}};
    return {{}, std::move(error_)};
  }

 private:
  const PlyElement& vertex() const { return header_.elements[header_.vertex]; }

  // Calls fn(block) for all blocks in parallel and keeps the error of the first block that has one.
  template <class Fn>
  bool for_each_block(const PlyExtent& extent, const Fn& fn) {
    std::vector<std::string> errors(extent.blocks.size());
    parallel::for_index(size_t{0}, extent.blocks.size(), [&](size_t i) { errors[i] = fn(extent.blocks[i]); });
    const auto found = std::find_if(errors.begin(), errors.end(), [](const auto& e) { return !e.empty(); });
    if (found != errors.end()) error_ = std::move(*found);
    return error_.empty();
  }

  // Indices of the named vertex properties, or nothing unless all of them exist.
  std::optional<std::vector<size_t>> columns(std::initializer_list<std::string_view> names) const {
    std::vector<size_t> found;
    for (const std::string_view name : names) {
      const auto i = vertex().find(name);
      if (!i) return std::nullopt;
      found.push_back(*i);
    }
    return found;
  }

  // The colour of a vertex; alpha is 1 where `columns` has no fourth entry.
  glm::vec4 colour_of(const PlyValues& v, const std::vector<size_t>& columns) const {
    glm::vec4 colour(1);
    for (size_t k = 0; k < columns.size(); ++k)
      colour[static_cast<int>(k)] =
          linear_colour(v.scalars[columns[k]], vertex().properties[columns[k]].type, k == 3);
    return colour;
  }

  bool read_vertices(const PlyExtent& extent) {
    const auto P = *columns({"x", "y", "z"});
    const auto N = columns({"nx", "ny", "nz"});
    auto uv = columns({"u", "v"});
    for (const auto& [u, v] : {std::pair{"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}})
      if (!uv) uv = columns({u, v});
    auto colour = columns({"red", "green", "blue", "alpha"});
    if (!colour) colour = columns({"red", "green", "blue"});
    if (!colours_) colour.reset();
    mesh_.P.resize(vertex().count);
    if (colour) mesh_.colours.resize(vertex().count);
    if (N) mesh_.N.resize(vertex().count);
    if (uv) mesh_.uv.resize(vertex().count);
    return for_each_block(extent, [&](const PlyBlock& block) {
      return read_ply_block(bytes_, header_, header_.vertex, block, std::nullopt, [&](const PlyValues& v) {
        const auto at = [&](size_t column) { return static_cast<float>(v.scalars[column]); };
        Point3& p = mesh_.P[v.number];
        p = {at(P[0]), at(P[1]), at(P[2])};
        if (N) mesh_.N[v.number] = {at((*N)[0]), at((*N)[1]), at((*N)[2])};
        if (uv) mesh_.uv[v.number] = {at((*uv)[0]), at((*uv)[1])};
        if (colour) mesh_.colours[v.number] = colour_of(v, *colour);
        return std::string();
      });
    });
  }

  bool read_faces(const PlyExtent& extent) {
    const auto list = header_.elements[header_.face].find_indices();
    mesh_.indices.resize(extent.triangles);
    const uint64_t faces = header_.elements[header_.face].count;
    const bool may_be_bare =
        mesh_.uv.empty() && extent.triangles > faces && extent.triangles + 2 * faces <= mesh_.P.size();
    BareFaces bare(may_be_bare ? mesh_.P.size() : 0);
    const bool read = for_each_block(extent, [&](const PlyBlock& block) {
      std::array<uint32_t, 3>* out = mesh_.indices.data() + block.triangles;
      std::vector<uint32_t> corners;
      return read_ply_block(bytes_, header_, header_.face, block, list, [&](const PlyValues& face) {
        corners.clear();
        for (const int64_t i : face.indices) {
          if (i < 0 || static_cast<uint64_t>(i) >= mesh_.P.size()) {
            return ply_error(face.position, fmt::format("face {} has vertex {}: there are {} vertices",
                                                        face.number, i, mesh_.P.size()));
          }
          corners.push_back(static_cast<uint32_t>(i));
        }
        triangulate(corners, mesh_.P, out);
        out += corners.size() - 2;
        if (may_be_bare) bare.add(corners);
        return std::string();
      });
    });
    if (read && may_be_bare) mesh_.uv = bare.take();
    return read;
  }

  std::string_view bytes_;
  const PlyHeader& header_;
  bool colours_;
  TriangleMesh mesh_;
  std::string error_;
};

MeshResult read_mesh(std::string_view bytes, bool colours) {
  std::string error;
  const auto header = read_ply_header(bytes, error);
  return header ? MeshReader(bytes, *header, colours).read() : MeshResult{{}, std::move(error)};
}

MeshResult read_packed(std::string_view bytes, const MemoryRoom& room, bool colours) {
  std::string error;
  const auto unpacked = unpack_gzip(bytes, room, error);
  return unpacked ? read_mesh(*unpacked, colours) : MeshResult{{}, std::move(error)};
}

}  // namespace

MeshResult load_ply(const ReadableFile& file, std::string* content, bool colours) {
  std::string error;
  const auto bytes = read_bytes(file, kLargestMeshFile, error);
  if (!bytes) return {{}, std::move(error)};
  if (content) {
    ContentHash hash;
    hash.add(*bytes);
    *content = hash.text();
  }
  MeshResult result =
      is_gzip(*bytes) ? read_packed(*bytes, file.room(), colours) : read_mesh(*bytes, colours);
  if (!result.error.empty())
    result.error = fmt::format("cannot read \"{}\": {}", file.path().string(), result.error);
  return result;
}

}  // namespace kaustik::pbrt
