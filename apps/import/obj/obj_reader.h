#pragma once
// Reads the text of an OBJ file into arrays. The text is cut into parts that are read in parallel: first the
// lines of each part are counted, so that in the second step each part knows which vertices precede it and
// where in the common arrays its own lie.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/import/common/counted_warnings.h"
#include "core/math/vec.h"

namespace kaustik::obj {

inline constexpr uint32_t kNone = 0xffffffffu;  // a corner without texture coordinates or normal

// Corners of faces: 0-based indices into the arrays of ObjText.
struct Corners {
  std::vector<uint32_t> v;
  std::vector<uint32_t> vt, vn;  // empty if no corner has one

  size_t size() const { return v.size(); }
  uint32_t vt_of(size_t i) const { return vt.empty() ? kNone : vt[i]; }
  uint32_t vn_of(size_t i) const { return vn.empty() ? kNone : vn[i]; }
  void add(const std::array<uint32_t, 3>& corner);
  void set_vn(size_t i, uint32_t normal);
  void drop_triangle();  // the last three corners
};

// A line that changes the state for the faces that follow it.
struct StateChange {
  enum class Kind { kObject, kGroup, kMaterial, kSmoothing, kLibrary };
  Kind kind;
  std::string name;      // what follows the keyword
  size_t face;           // number of faces before it in this part
  SourceLocation where;  // of the name
};

// A part of the file.
struct ObjPart {
  Corners corners;
  std::vector<uint32_t> sizes;  // corners of each face, at least three
  std::vector<StateChange> changes;
  std::vector<glm::vec3>
      colours;  // of its vertices, linear, white where there is none; empty if none has one
  CountedWarnings warnings;
};

struct ObjText {
  std::vector<glm::dvec3> P;
  std::vector<glm::vec3> colours;  // of the vertices, or empty
  std::vector<glm::vec2> uv;
  std::vector<glm::vec3> N;
  std::vector<ObjPart> parts;

  size_t faces() const {
    size_t n = 0;
    for (const ObjPart& part : parts) n += part.sizes.size();
    return n;
  }
};

// Reads the file's text, which must stay while this runs. The errors are those without which the picture
// would be wrong: coordinates that are no numbers, and indices of vertices that are none or out of range; the
// first one is reported, with the number of the others. The parts keep their warnings.
std::optional<ObjText> read_obj(std::string_view text, uint32_t file, DiagnosticList& diagnostics);

}  // namespace kaustik::obj
