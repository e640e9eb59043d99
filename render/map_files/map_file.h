#pragma once
// Files of photon maps (.kmap): mapped into memory as they lie, so that opening one takes the time of reading
// what is touched, and processes share it.
//
//   8 bytes   "KPMAP\r\n\x1a"
//   8 bytes   version of the format, 1
//   8 bytes   size of the manifest: JSON, UTF-8
//   8 bytes   size of the table of hashes
//   16 bytes  ContentHash of manifest and table
//   the manifest; the table: a ContentHash, 16 bytes, of each chunk of 2^20 bytes of each array
//   the arrays of each map, in the order of the manifest, each at a multiple of 4096 bytes from the file's
//   beginning: columns in Morton order, nodes and entries of the octree, boxes and surfaces of the tree of
//   boxes (photon/map)
//
// Integers and floats are little-endian.

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/files/mapped_file.h"
#include "photon/trace/trace_settings.h"
#include "render/maps/kept_photons.h"
#include "render/passes/partial_result.h"

namespace kaustik::render {

// what() begins with the path.
class MapFileError : public std::runtime_error {
 public:
  MapFileError(const std::string& path, const std::string& message)
      : std::runtime_error(path + ": " + message) {}
};

// Describes the render that the photons come from.
struct MapManifest {
  std::string build;       // identifies the program
  std::string isa;         // instruction sets that determine its bits
  std::string scene_path;  // absolute
  std::string scene_hash;  // hash of the contents of the scene's files
  SettingTexts settings;   // those that the photons depend on
  std::string cameras;     // hash of the cameras for which they were shot, or "all"
  std::string estimators;  // that chose the radii, such as "predicted photons"
  photon::KindMask kinds;  // that were stored
  // As in photon::TraceSettings.
  bool under_glossy = false, shadow_behind_specular = false;
};

// Whether a path ends in .kmap.
bool is_map_name(const std::string& path);

// Writes to a temporary name in the same folder and renames it when it is complete and on the disk. Throws
// MapFileError.
void write_map_file(const std::string& path, const MapManifest& manifest, const KeptPhotons& photons);

// A file that is open for reading. Copies share the mapping.
class MapFile {
 public:
  // Checks header, manifest and size. Throws MapFileError for files that are no photon maps, have another
  // version of the format, or are truncated or damaged, and says which.
  explicit MapFile(const std::string& path);

  const std::string& path() const { return path_; }
  const MapManifest& manifest() const { return manifest_; }
  uint64_t photons() const;  // of all kinds
  // The photons, whose columns stay in the file. Checks the arrays that lead to them: octrees and boxes.
  // Throws MapFileError for damaged ones.
  KeptPhotons open() const;
  // Checks the columns, which takes the time of reading them. Throws MapFileError for damaged ones.
  void check_columns() const;

 private:
  static constexpr size_t kArrays = 5;  // of a map
  struct Array {
    uint64_t begin = 0, bytes = 0;  // place in the file
    uint64_t first_hash = 0;        // index of its first chunk in the table
  };
  struct Map {
    photon::PhotonKind kind{};
    uint64_t photons = 0;
    float flux_unit = 1;
    photon::FluxColours colours = photon::FluxColours::kRgb;
    photon::MortonCube cube{};
    std::array<Array, kArrays> arrays{};
  };
  void read_manifest(std::string_view text);
  void place_arrays(uint64_t begin);
  void check(const Array& array) const;
  template <class T>
  SharedArray<T> array(const Array& array) const;

  std::string path_;
  std::shared_ptr<const MappedFile> file_;
  MapManifest manifest_;
  GatherRadii radii_;
  RenderStatistics statistics_;
  std::vector<Map> maps_;
  const std::byte* hashes_ = nullptr;
};

}  // namespace kaustik::render
