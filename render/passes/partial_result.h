#pragma once
// File format for part of a render: a checkpoint, one machine's share of a render job, or the merge of
// several parts.
//
//   8 bytes   "KPART\r\n\x1a"
//   8 bytes   version of the format, 3
//   8 bytes   size of the manifest, which follows: JSON, UTF-8
//   if it holds any pass, a PixelTotals for each pixel of the window (640 bytes), rows from the top
//   and, if the samples are kept in halves, a HalfTotals for each pixel (416 bytes), likewise
//   and, if media of the scene scatter, a MediaTotals for each pixel (144 bytes), likewise
//   16 bytes  ContentHash of everything before
//
// Integers are little-endian, sums in two's complement.

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

// Settings as text: option name and values.
using SettingTexts = std::vector<std::pair<std::string, std::vector<std::string>>>;

// Describes the render that sums come from. Sums can be added if everything but scene_path, presentation,
// outputs, goal and stopped_by agrees.
struct PartialManifest {
  std::string build;                 // identifies the program
  std::string isa;                   // instruction sets that determine its bits
  std::string scene_path;            // absolute
  std::string scene_hash;            // hash of the contents of the scene's files, including meshes
  SettingTexts settings;             // those that determine the sums
  SettingTexts presentation;         // those that affect only speed, or what is made of the sums
  std::vector<std::string> outputs;  // absolute paths
  PassSet goal;                      // passes that were to be rendered
  std::string stopped_by;            // the rule that stopped the render before its goal, or empty
  SceneNeeds needs;
};

struct PartialResult {
  PartialManifest manifest;
  PassSums sums;
};

// Whether a path ends in .kpart.
bool is_partial_name(const std::string& path);

// Writes a PendingFile: an interrupted write leaves the previous file as it was. Throws PartialError.
void write_partial(const std::string& path, const PartialManifest& manifest, const PassSums& sums);

// Throws PartialError for files that are not partial results, have another version of the format, or are
// truncated or damaged, and says which. Sizes are checked against the file's size before memory is allocated.
PartialResult read_partial(const std::string& path);

// Why the sums of two files cannot be added, such as "they differ in --seed: 0 and 1"; empty if they can.
// Which passes they hold is not considered.
std::string difference(const PartialResult& a, const PartialResult& b);

}  // namespace kaustik::render
