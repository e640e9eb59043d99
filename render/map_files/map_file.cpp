// Reads map files, with checks of size, version and hashes.

#include "render/map_files/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/files/content_hash.h"
#include "core/parallel/parallel.h"
#include "render/map_files/map_layout.h"
#include "render/passes/json_numbers.h"
#include "render/passes/manifest_values.h"
#include "render/settings/names.h"

namespace kaustik::render {

namespace {

using Json = ManifestJson;

std::shared_ptr<const MappedFile> map_file(const std::string& path) {
  try {
    return std::make_shared<const MappedFile>(path);
  } catch (const FileError& error) {
    throw MapFileError(path, error.what());
  }
}

uint64_t word_at(const std::byte* bytes, size_t index) {
  uint64_t word = 0;
  std::memcpy(&word, bytes + index * sizeof word, sizeof word);
  return word;
}

photon::PhotonKind kind_named(const std::string& name) {
  const auto kind = from_name<photon::PhotonKind>(photon::kPhotonKindNames, name);
  if (!kind) throw std::runtime_error(fmt::format("`{}` is no kind of photon", name));
  return *kind;
}

photon::FluxColours colours_named(const std::string& name) {
  const auto colours = from_name<photon::FluxColours>(photon::kFluxColoursNames, name);
  if (!colours) throw std::runtime_error(fmt::format("`{}` are no colours of photons", name));
  return *colours;
}

photon::MortonCube cube_from(const Json& json) {
  const auto number = [&](size_t i) { return finite_from_hex(json.at(i)); };
  photon::MortonCube cube{{number(0), number(1), number(2)}, number(3), number(4)};
  if (!(cube.size > 0 && cube.cells_per_metre > 0)) throw std::runtime_error("the cube has no size");
  return cube;
}

}  // namespace

MapFile::MapFile(const std::string& path) : path_(path), file_(map_file(path)) {
  const auto fail = [&](const std::string& why) { throw MapFileError(path, why); };
  const std::span<const std::byte> all = file_->bytes();
  if (all.size() < kMapMagic.size() || std::memcmp(all.data(), kMapMagic.data(), kMapMagic.size()) != 0)
    fail("not a photon map of kaustik");
  if (all.size() < kMapHeadBytes) fail("the file is truncated: its header is incomplete");
  if (const uint64_t version = word_at(all.data(), 1); version != kMapVersion)
    fail(fmt::format("version {} of the format; this program reads version {}", version, kMapVersion));
  const uint64_t text = word_at(all.data(), 2), table = word_at(all.data(), 3);
  const uint64_t left = all.size() - kMapHeadBytes;
  if (text > left || table > left - text) fail("the file is truncated: its manifest is incomplete");
  ContentHash hash;
  hash.add(all.data() + kMapHeadBytes, text + table);
  if (hash.words() != std::array{word_at(all.data(), 4), word_at(all.data(), 5)})
    fail("the file is damaged: the checksum of its manifest does not match");
  hashes_ = all.data() + kMapHeadBytes + text;
  try {
    read_manifest({reinterpret_cast<const char*>(all.data() + kMapHeadBytes), text});
  } catch (const std::exception& error) {
    fail(fmt::format("its manifest is damaged: {}", error.what()));
  }
  place_arrays(kMapHeadBytes + text + table);
  const Array& last = maps_.back().arrays.back();
  if (last.begin + last.bytes != all.size() ||
      (last.first_hash + chunks_of(last.bytes)) * kHashBytes != table)
    fail("the file is truncated or damaged: its size does not match its photons");
}

void MapFile::read_manifest(std::string_view text) {
  const Json json = Json::parse(text);
  MapManifest& m = manifest_;
  json.at("build").get_to(m.build);
  json.at("isa").get_to(m.isa);
  json.at("scene").at("path").get_to(m.scene_path);
  json.at("scene").at("hash").get_to(m.scene_hash);
  m.settings = settings_from(json.at("settings"));
  json.at("cameras").get_to(m.cameras);
  json.at("estimators").get_to(m.estimators);
  json.at("under_glossy").get_to(m.under_glossy);
  json.at("shadow_behind_specular").get_to(m.shadow_behind_specular);
  const std::optional<GatherRadii> radii = radii_from(json.at("radii"));
  if (!radii) throw std::runtime_error("the gather radii are missing");
  radii_ = *radii;
  statistics_ = statistics_from(json.at("statistics"));
  for (const Json& entry : json.at("maps")) {
    Map map{.kind = kind_named(entry.at("kind").get<std::string>())};
    take_whole(entry, "photons", &map.photons);
    map.flux_unit = finite_from_hex(entry.at("flux_unit"));
    map.colours = colours_named(entry.value("colours", "rgb"));
    map.cube = cube_from(entry.at("cube"));
    for (size_t a = 0; a < kArrays; ++a)
      map.arrays[a].bytes = whole_number<uint64_t>(entry.at("bytes").at(a), "bytes");
    m.kinds[map.kind] = true;
    maps_.push_back(map);
  }
  if (maps_.empty()) throw std::runtime_error("it has no maps");
}

void MapFile::place_arrays(uint64_t begin) {
  const uint64_t end = file_->bytes().size();
  uint64_t hashes = 0;
  for (Map& map : maps_) {
    for (Array& array : map.arrays) {
      array.begin = aligned(begin);
      array.first_hash = hashes;
      if (array.begin > end || array.bytes > end - array.begin)
        throw MapFileError(path_, "the file is truncated: some of its photons are missing");
      begin = array.begin + array.bytes;
      hashes += chunks_of(array.bytes);
    }
  }
}

void MapFile::check(const Array& array) const {
  const std::span<const std::byte> bytes = file_->bytes().subspan(array.begin, array.bytes);
  parallel::for_index(uint64_t{0}, chunks_of(array.bytes), [&](uint64_t i) {
    const std::span<const std::byte> chunk = chunk_of(bytes, i);
    const std::byte* stored = hashes_ + (array.first_hash + i) * kHashBytes;
    if (hash_of(chunk) == std::array{word_at(stored, 0), word_at(stored, 1)}) return;
    const uint64_t begin = array.begin + i * kHashedChunk;
    throw MapFileError(path_, fmt::format("the file is damaged: bytes {} to {} do not match their checksum",
                                          begin, begin + chunk.size() - 1));
  });
}

template <class T>
SharedArray<T> MapFile::array(const Array& array) const {
  const void* first = file_->bytes().data() + array.begin;
  return {{static_cast<const T*>(first), array.bytes / sizeof(T)}, file_};
}

uint64_t MapFile::photons() const {
  uint64_t sum = 0;
  for (const Map& map : maps_) sum += map.photons;
  return sum;
}

KeptPhotons MapFile::open() const {
  KeptPhotons out{.radii = radii_, .statistics = statistics_};
  for (const Map& map : maps_) {
    for (const Array& array : std::span(map.arrays).subspan(1)) check(array);
    photon::PhotonMapParts parts{
        .size = map.photons, .flux_unit = map.flux_unit, .colours = map.colours, .cube = map.cube};
    parts.columns = array<photon::ColumnLine>(map.arrays[0]);
    parts.nodes = array<photon::OctreeNode>(map.arrays[1]);
    parts.entries = array<uint32_t>(map.arrays[2]);
    parts.boxes = array<photon::BoxNode>(map.arrays[3]);
    parts.surfaces = array<photon::BoxTree::Surfaces>(map.arrays[4]);
    try {
      out.maps[size_t(map.kind)] = photon::PhotonMap(std::move(parts));
    } catch (const std::invalid_argument& error) {
      throw MapFileError(path_, fmt::format("the file is damaged: {}", error.what()));
    }
  }
  return out;
}

void MapFile::check_columns() const {
  for (const Map& map : maps_) check(map.arrays[0]);
}

}  // namespace kaustik::render
