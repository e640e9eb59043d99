#pragma once
// Where the camera of a sequence is in each frame, read from a JSON file.

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/description/description.h"

namespace kaustik::app {

inline constexpr uint64_t kMostFrames = 1'000'000;  // of a sequence

// Values of --look-at and --fov. All numbers are floats, so that the options give them again exactly.
struct FrameView {
  std::array<double, 9> look_at{};  // eye, target, up
  std::optional<double> fov{};      // degrees; unset: the scene's
  // The values as texts.
  std::vector<std::string> look_at_texts() const;
  std::vector<std::string> fov_texts() const;  // empty if unset
  std::string options() const;                 // "--look-at ... --fov ..."
};

// Either keys, between which cubic curves run (Catmull and Rom 1974) or straight lines, or a turntable, which
// turns the scene's camera about an axis. docs/reference/command_line.md describes the file.
class CameraPath {
 public:
  // Throws ExitError (bad command line), after printing errors with their places to `err`, for a file that
  // cannot be read.
  static CameraPath read(const std::string& file, std::ostream& err);

  uint64_t frames() const { return frames_; }
  // frame: below frames(). camera: the scene's, which only a turntable reads.
  FrameView at(uint64_t frame, const std::optional<CameraDescription>& camera) const;

 private:
  static constexpr size_t kNumbers = 10;  // eye, target, up, fov
  struct Key {
    double frame = 0;
    std::array<double, kNumbers> numbers{};
  };
  struct Turntable {
    glm::dvec3 center{0}, axis{0, 1, 0};
    double degrees = 360;  // in all frames
  };
  friend class PathReader;
  std::array<double, kNumbers> between(double frame) const;

  uint64_t frames_ = 0;
  std::vector<Key> keys_;  // ascending; empty for a turntable
  bool smooth_ = true, has_fov_ = false;
  Turntable turntable_;
};

}  // namespace kaustik::app
