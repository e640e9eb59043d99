#pragma once
// One file for a part of a render: checkpoint, share of a farm's job, and what parts are joined into.
//
//   8 bytes   "KPART\r\n\x1a"
//   8 bytes   version of the format, 2
//   8 bytes   size of the manifest, which follows: JSON, UTF-8
//   480 bytes for each pixel of the window, rows from the top: a PixelTotals
//   16 bytes  ContentHash of all before
//
// Whole numbers are little-endian, sums two's complement.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/needs.h"
#include "render/passes/pass_sums.h"

namespace kaustik::render {

// what() begins with the path.
class PartialError : public std::runtime_error {
 public:
  PartialError(const std::string& path, const std::string& message)
      : std::runtime_error(path + ": " + message) {}
};

// Settings by the names of their options, as texts.
using SettingTexts = std::vector<std::pair<std::string, std::vector<std::string>>>;

// Where sums come from. Sums belong together where all but scene_path, presentation, outputs, goal
// and stopped_by agree.
struct PartialManifest {
  std::string build;                 // of the program
  std::string isa;                   // instructions that decide its bits
  std::string scene_path;            // absolute
  std::string scene_hash;            // of the contents of the scene's files, meshes included
  SettingTexts settings;             // that decide the sums
  SettingTexts presentation;         // that decide how fast, and what is made of the sums
  std::vector<std::string> outputs;  // absolute paths
  PassSet goal;                      // passes that the render was to hold
  std::string stopped_by;            // the rule that found these passes enough, or nothing
  SceneNeeds needs;
};

struct PartialResult {
  PartialManifest manifest;
  PassSums sums;
};

// Whether a path ends in .kpart.
bool is_partial_name(const std::string& path);

// The file appears under its name only when it is complete and on the disk: until then it is
// .NAME.partial beside it, so that a kill leaves the previous file as it was, and what it leaves behind is
// overwritten by the next write. One writer of a path at a time. Throws PartialError.
void write_partial(const std::string& path, const PartialManifest& manifest, const PassSums& sums);

// Throws PartialError for what is no such file, of another version of the format, truncated or damaged,
// saying which; sizes are checked against the file's before memory is taken for them.
PartialResult read_partial(const std::string& path);

// Why the sums of two files cannot be joined: "they have different seeds: 0 and 1"; empty when they can. Does
// not look at which passes they hold.
std::string difference(const PartialResult& a, const PartialResult& b);

}  // namespace kaustik::render
