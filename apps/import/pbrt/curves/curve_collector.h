#pragma once
// Gathers the curves of a scene, of which hair has a million, into few meshes.

#include <optional>
#include <vector>

#include "apps/import/common/counted_warnings.h"
#include "apps/import/pbrt/curves/tubes.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

class CurveCollector {
 public:
  explicit CurveCollector(CountedWarnings& warnings) : warnings_(warnings) {}

  // Takes a Shape "curve", of the object with this index if there is one. A curve without enough points is
  // left out with a warning.
  void add(const ShapeDescription& curve, std::optional<size_t> object);

  // Adds one mesh to the scene for all curves of the same material, light and orientation.
  void finish(SceneDescription& scene);

 private:
  struct Group {
    std::optional<size_t> object;
    ShapeDescription shape;  // of the first curve, without parameters
    std::vector<CurveSegment> segments;
  };
  Group& group_of(const ShapeDescription& curve, std::optional<size_t> object);

  CountedWarnings& warnings_;
  std::vector<Group> groups_;
  size_t last_ = 0;  // the group of the curve before
};

}  // namespace kaustik::pbrt
