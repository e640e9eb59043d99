#pragma once
// The animations of a glTF file at one moment.

#include <map>
#include <optional>
#include <vector>

#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/document.h"

namespace kaustik::gltf {

// What animations say of a node; parts that they leave alone are unset.
struct NodePose {
  // Three numbers; four (quaternion x, y, z, w); three; one per morph target.
  std::optional<std::vector<double>> translation, rotation, scale, weights;
};

class Pose {
 public:
  // The pose of every animated node after `seconds`; before its first and after its last key a channel keeps
  // that key's value. All animations of the file are played at once; where two of them move the same part of
  // a node, the first counts. Channels that cannot be read are left out with a warning.
  Pose(const Document& document, double seconds, FileWarnings& warnings);

  // Null for nodes that are not animated.
  const NodePose* of(uint64_t node) const;
  bool animated() const { return !nodes_.empty(); }
  double duration() const { return duration_; }  // time of the last key, in seconds

 private:
  void add_channel(const Document& document, const View& animation, const View& channel, double seconds,
                   FileWarnings& warnings);

  std::map<uint64_t, NodePose> nodes_;
  double duration_ = 0;
};

}  // namespace kaustik::gltf
