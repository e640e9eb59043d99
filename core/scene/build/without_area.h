#pragma once
// One warning about all triangles of a scene that have no area.

#include <fmt/format.h>

#include <set>

#include "core/diagnostics/diagnostics.h"

namespace kaustik {

class TrianglesWithoutArea {
 public:
  // Counts those of a mesh, which was made from an item of the scene; further meshes of the same item, its
  // instances, are not counted.
  void add(size_t item, const SourceLocation& where, uint64_t left_out, uint64_t triangles) {
    if (!items_.insert(item).second) return;
    if (items_.size() == 1) first_ = where;
    left_out_ += left_out;
    triangles_ += triangles;
  }

  // Warns at the first mesh, if there is any.
  void report(DiagnosticList& diagnostics) const {
    if (items_.empty()) return;
    const std::string meshes = items_.size() == 1 ? "" : fmt::format(" in {} meshes", items_.size());
    diagnostics.warning(first_, fmt::format("{} of {} triangles{} have no area and are left out", left_out_,
                                            triangles_, meshes));
  }

 private:
  std::set<size_t> items_;
  SourceLocation first_;
  uint64_t left_out_ = 0, triangles_ = 0;
};

}  // namespace kaustik
