// Writes a map file: hashes all arrays, then writes header, manifest, hashes and arrays.

#include <array>
#include <bit>
#include <filesystem>
#include <span>

#include "core/files/pending_file.h"
#include "core/parallel/parallel.h"
#include "render/map_files/map_file.h"
#include "render/map_files/map_layout.h"
#include "render/passes/manifest_values.h"

namespace kaustik::render {

namespace {

static_assert(std::endian::native == std::endian::little);

using Json = ManifestJson;
using Bytes = std::span<const std::byte>;

template <class T>
Bytes bytes_of(const SharedArray<T>& array) {
  return std::as_bytes(array.span());
}

struct WrittenMap {
  photon::PhotonKind kind{};
  photon::PhotonMapParts parts;
  std::array<Bytes, 5> arrays() const {
    return {bytes_of(parts.columns), bytes_of(parts.nodes), bytes_of(parts.entries), bytes_of(parts.boxes),
            bytes_of(parts.surfaces)};
  }
};

Json map_json(const WrittenMap& map) {
  const photon::MortonCube& cube = map.parts.cube;
  Json bytes = Json::array();
  for (const Bytes array : map.arrays()) bytes.push_back(array.size());
  return {{"kind", photon::kPhotonKindNames[size_t(map.kind)]},
          {"photons", map.parts.size},
          {"flux_unit", hex_text(map.parts.flux_unit)},
          {"colours", photon::kFluxColoursNames[size_t(map.parts.colours)]},
          {"cube",
           {hex_text(cube.origin.x), hex_text(cube.origin.y), hex_text(cube.origin.z), hex_text(cube.size),
            hex_text(cube.cells_per_metre)}},
          {"bytes", bytes}};
}

std::string manifest_text(const MapManifest& m, const KeptPhotons& photons,
                          const std::vector<WrittenMap>& maps) {
  Json out;
  out["build"] = m.build;
  out["isa"] = m.isa;
  out["scene"] = {{"path", m.scene_path}, {"hash", m.scene_hash}};
  out["settings"] = settings_json(m.settings);
  out["cameras"] = m.cameras;
  out["estimators"] = m.estimators;
  out["under_glossy"] = m.under_glossy;
  out["shadow_behind_specular"] = m.shadow_behind_specular;
  out["radii"] = radii_json(photons.radii);
  out["statistics"] = statistics_values(photons.statistics);
  out["maps"] = Json::array();
  for (const WrittenMap& map : maps) out["maps"].push_back(map_json(map));
  try {
    return out.dump(1);
  } catch (const Json::exception&) {
    throw FileError("the name of the scene is not UTF-8");
  }
}

void add_hashes(Bytes array, std::vector<std::array<uint64_t, 2>>* table) {
  const size_t first = table->size();
  table->resize(first + chunks_of(array.size()));
  parallel::for_index(first, table->size(),
                      [&](size_t i) { (*table)[i] = hash_of(chunk_of(array, i - first)); });
}

// Writes bytes, words and the gaps between arrays.
class MapWriter {
 public:
  explicit MapWriter(PendingFile& file) : file_(file) {}
  void put(const void* bytes, size_t size) { file_.write(bytes, size); }
  void put(uint64_t word) { put(&word, sizeof word); }
  void align() {
    const std::vector<char> zeros(aligned(file_.position()) - file_.position());
    put(zeros.data(), zeros.size());
  }

 private:
  PendingFile& file_;
};

void write(PendingFile& file, const std::string& manifest, const std::vector<WrittenMap>& maps) {
  std::vector<std::array<uint64_t, 2>> table;
  for (const WrittenMap& map : maps)
    for (const Bytes array : map.arrays()) add_hashes(array, &table);
  const size_t table_bytes = table.size() * kHashBytes;
  ContentHash hash;
  hash.add(manifest);
  hash.add(table.data(), table_bytes);
  MapWriter out(file);
  out.put(kMapMagic.data(), kMapMagic.size());
  for (const uint64_t word : {kMapVersion, uint64_t(manifest.size()), uint64_t(table_bytes)}) out.put(word);
  for (const uint64_t word : hash.words()) out.put(word);
  out.put(manifest.data(), manifest.size());
  out.put(table.data(), table_bytes);
  for (const WrittenMap& map : maps) {
    for (const Bytes array : map.arrays()) {
      out.align();
      out.put(array.data(), array.size());
    }
  }
}

}  // namespace

bool is_map_name(const std::string& path) {
  return std::filesystem::path(path).extension() == ".kmap";
}

void write_map_file(const std::string& path, const MapManifest& manifest, const KeptPhotons& photons) {
  std::vector<WrittenMap> maps;
  for (size_t k = 0; k < photons.maps.size(); ++k) {
    const auto kind = static_cast<photon::PhotonKind>(k);
    if (manifest.kinds[kind]) maps.push_back({kind, photons.maps[k].parts()});
  }
  try {
    PendingFile file(path);
    write(file, manifest_text(manifest, photons, maps), maps);
    file.commit();
  } catch (const FileError& error) {
    throw MapFileError(path, error.what());
  }
}

}  // namespace kaustik::render
