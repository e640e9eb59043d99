#pragma once
// Collects the triangles of an OBJ file into meshes of one group and one material each.

#include "apps/import/obj/obj_reader.h"
#include "core/scene/description/description.h"

namespace kaustik::obj {

// Triangles that follow each other in one part of the file.
struct Run {
  uint32_t part;
  size_t begin, end;
  uint32_t smoothing;  // 0: faces are flat
};

struct ObjMesh {
  std::string name;      // its object's, or else its group's, and its material's
  std::string material;  // as `usemtl` names it; empty before the first one
  SourceLocation material_where;
  SourceLocation where;  // of the name of its object, group or material, whichever is last; or the file
  std::vector<Run> runs;
  size_t triangles = 0;
};

// The meshes in the order in which they begin. Triangles of one object, group and material form one mesh even
// where they do not follow each other. In files of more than 4,096 such meshes, those of one material do.
std::vector<ObjMesh> meshes_of(const ObjText& text, const SourceLocation& file);

// Gives the corners without a normal in smoothing groups the mean of the normals of the adjacent triangles of
// the same group, weighted by area. As an edge sharper than 80 degrees shows, it is not rounded off.
void add_smooth_normals(ObjText& text, const std::vector<ObjMesh>& meshes);

// Makes triangle meshes. Corners become one vertex if they agree in position, texture coordinates and normal.
// Where only some corners of a mesh have a normal, the others get that of their triangle; those without
// texture coordinates get (0, 0).
class MeshMaker {
 public:
  explicit MeshMaker(ObjText& text) : text_(text), head_(text.P.size(), kNone) {}

  // The shape without its material.
  ShapeDescription make(const ObjMesh& mesh, CountedWarnings& warnings);

 private:
  struct Vertex {
    uint32_t v, vt, vn;
    uint32_t next;  // another vertex at the same position
  };
  uint32_t vertex(uint32_t v, uint32_t vt, uint32_t vn);
  uint32_t usable_normal(const Corners& corners, size_t corner, CountedWarnings& warnings);

  ObjText& text_;
  std::vector<uint32_t> head_;  // the first vertex at each position
  std::vector<Vertex> vertices_;
  SourceLocation where_;
};

}  // namespace kaustik::obj
