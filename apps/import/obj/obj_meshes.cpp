#include "apps/import/obj/obj_meshes.h"

#include <algorithm>
#include <map>

#include "apps/import/common/make_parameter.h"
#include "apps/import/obj/obj_text.h"
#include "apps/import/obj/obj_triangles.h"
#include "core/text.h"

namespace kaustik::obj {
namespace {

constexpr size_t kMostMeshes = 4096;
constexpr double kSharpestSmoothEdge = 0.1736481776669303;  // the cosine of 80 degrees

// Walks over the parts and keeps the state that their lines change.
class Collector {
 public:
  Collector(const SourceLocation& file, bool by_group)
      : by_group_(by_group), where_(file), material_where_(file) {}

  // False when there are too many meshes.
  bool collect(const ObjText& text) {
    for (uint32_t i = 0; i < text.parts.size(); ++i) {
      const ObjPart& part = text.parts[i];
      size_t begin = 0;
      for (const StateChange& change : part.changes) {
        add_run({i, begin, change.face, smoothing_});
        begin = change.face;
        apply(change);
      }
      add_run({i, begin, part.corners.size() / 3, smoothing_});
      if (by_group_ && meshes_.size() > kMostMeshes) return false;
    }
    return true;
  }
  std::vector<ObjMesh> take() { return std::move(meshes_); }

 private:
  void apply(const StateChange& change) {
    using Kind = StateChange::Kind;
    if (change.kind == Kind::kObject) object_ = change.name, group_.clear();
    if (change.kind == Kind::kGroup) group_ = change.name;
    if (change.kind == Kind::kMaterial) material_ = change.name, material_where_ = change.where;
    if (change.kind == Kind::kSmoothing) smoothing_ = smoothing_of(lower_case(change.name));
    if (change.kind != Kind::kSmoothing && change.kind != Kind::kLibrary) where_ = change.where;
    current_ = nullptr;
  }

  uint32_t smoothing_of(const std::string& name) {
    if (name.empty() || name == "off" || name == "0" || name == "null") return 0;
    return smoothing_names_.try_emplace(name, uint32_t(smoothing_names_.size()) + 1).first->second;
  }

  std::string name() const {
    const std::string& of_faces = object_.empty() ? group_ : object_;
    if (!by_group_ || of_faces.empty()) return material_;
    return material_.empty() || material_ == of_faces ? of_faces : of_faces + ", " + material_;
  }

  void add_run(const Run& run) {
    if (run.begin == run.end) return;
    if (!current_) {
      const std::string group = by_group_ ? object_ + '\n' + group_ : "";
      const auto [at, is_new] = indices_.try_emplace({group, material_}, meshes_.size());
      if (is_new) meshes_.push_back({name(), material_, material_where_, where_, {}, 0});
      current_ = &meshes_[at->second];
    }
    current_->runs.push_back(run);
    current_->triangles += run.end - run.begin;
  }

  bool by_group_;
  SourceLocation where_, material_where_;
  std::string object_, group_, material_;
  uint32_t smoothing_ = 0;
  std::map<std::string, uint32_t> smoothing_names_;
  std::map<std::pair<std::string, std::string>, size_t> indices_;
  std::vector<ObjMesh> meshes_;
  ObjMesh* current_ = nullptr;
};

// The normals under construction at each position.
class SmoothNormals {
 public:
  explicit SmoothNormals(ObjText& text) : text_(text), head_(text.P.size(), kNone) {}

  // Adds a triangle's normal, weighted by area, at vertex v. Returns the index of the normal among text.N.
  uint32_t add(uint32_t v, uint32_t smoothing, const glm::dvec3& n) {
    for (uint32_t i = head_[v]; i != kNone; i = sums_[i].next) {
      Sum& sum = sums_[i];
      if (sum.smoothing != smoothing ||
          glm::dot(sum.n, n) < kSharpestSmoothEdge * glm::length(sum.n) * glm::length(n))
        continue;
      sum.n += n;
      return first_ + i;
    }
    sums_.push_back({n, smoothing, head_[v]});
    head_[v] = uint32_t(sums_.size() - 1);
    return first_ + head_[v];
  }

  void finish() {
    text_.N.reserve(text_.N.size() + sums_.size());
    for (const Sum& sum : sums_) text_.N.emplace_back(glm::normalize(sum.n));
  }

 private:
  struct Sum {
    glm::dvec3 n;
    uint32_t smoothing, next;
  };
  ObjText& text_;
  const uint32_t first_ = uint32_t(text_.N.size());
  std::vector<uint32_t> head_;
  std::vector<Sum> sums_;
};

template <class V>
std::vector<double> as_numbers(size_t count, const V& value) {
  std::vector<double> out;
  const size_t size = size_t(value(0).length());
  out.reserve(count * size);
  for (size_t i = 0; i < count; ++i) {
    const auto v = value(i);
    for (int k = 0; k < v.length(); ++k) out.push_back(double(v[k]));
  }
  return out;
}

}  // namespace

std::vector<ObjMesh> meshes_of(const ObjText& text, const SourceLocation& file) {
  for (const bool by_group : {true, false}) {
    Collector collector(file, by_group);
    if (collector.collect(text)) return collector.take();
  }
  return {};
}

void add_smooth_normals(ObjText& text, const std::vector<ObjMesh>& meshes) {
  std::optional<SmoothNormals> normals;
  for (const ObjMesh& mesh : meshes) {
    for (const Run& run : mesh.runs) {
      if (run.smoothing == 0) continue;
      Corners& corners = text.parts[run.part].corners;
      for (size_t i = 3 * run.begin; i < 3 * run.end; ++i) {
        if (corners.vn_of(i) != kNone) continue;
        if (!normals) normals.emplace(text);
        corners.set_vn(i, normals->add(corners.v[i], run.smoothing, area_vector(text, corners, i / 3)));
      }
    }
  }
  if (normals) normals->finish();
}

uint32_t MeshMaker::vertex(uint32_t v, uint32_t vt, uint32_t vn) {
  for (uint32_t i = head_[v]; i != kNone; i = vertices_[i].next)
    if (vertices_[i].vt == vt && vertices_[i].vn == vn) return i;
  vertices_.push_back({v, vt, vn, head_[v]});
  return head_[v] = uint32_t(vertices_.size() - 1);
}

// The corner's normal, or else that of its triangle.
uint32_t MeshMaker::usable_normal(const Corners& corners, size_t corner, CountedWarnings& warnings) {
  const uint32_t vn = corners.vn_of(corner);
  if (vn != kNone && is_finite(text_.N[vn]) && text_.N[vn] != glm::vec3(0)) return vn;
  if (vn != kNone)
    warnings.say(where_, "a normal is zero or not finite: the corner has the normal of its face");
  text_.N.emplace_back(glm::normalize(area_vector(text_, corners, corner / 3)));
  return uint32_t(text_.N.size() - 1);
}

ShapeDescription MeshMaker::make(const ObjMesh& mesh, CountedWarnings& warnings) {
  bool has_uv = false, has_normals = false;
  for (const Run& run : mesh.runs) {
    const Corners& corners = text_.parts[run.part].corners;
    for (size_t i = 3 * run.begin; i < 3 * run.end; ++i) {
      has_uv = has_uv || corners.vt_of(i) != kNone;
      has_normals = has_normals || corners.vn_of(i) != kNone;
    }
  }
  where_ = mesh.where;
  vertices_.clear();
  std::vector<double> indices;
  indices.reserve(3 * mesh.triangles);
  for (const Run& run : mesh.runs) {
    const Corners& corners = text_.parts[run.part].corners;
    for (size_t i = 3 * run.begin; i < 3 * run.end; ++i) {
      const uint32_t vn = has_normals ? usable_normal(corners, i, warnings) : kNone;
      indices.push_back(double(vertex(corners.v[i], corners.vt_of(i), vn)));
    }
  }
  for (const Vertex& vertex : vertices_) head_[vertex.v] = kNone;
  DirectiveMaker<ShapeDescription> shape("trianglemesh", mesh.where);
  const size_t count = vertices_.size();
  shape.add(ParameterType::kPoint3, "P",
            as_numbers(count, [&](size_t i) { return text_.P[vertices_[i].v]; }));
  shape.add(ParameterType::kInteger, "indices", std::move(indices));
  if (has_normals)
    shape.add(ParameterType::kNormal, "N",
              as_numbers(count, [&](size_t i) { return text_.N[vertices_[i].vn]; }));
  if (!text_.colours.empty())
    shape.add(ParameterType::kFloat, "Cd",
              as_numbers(count, [&](size_t i) { return glm::vec4(text_.colours[vertices_[i].v], 1); }));
  if (has_uv)
    shape.add(ParameterType::kPoint2, "uv", as_numbers(count, [&](size_t i) {
                const uint32_t vt = vertices_[i].vt;
                return vt == kNone ? glm::vec2(0) : text_.uv[vt];
              }));
  return std::move(*shape);
}

}  // namespace kaustik::obj
