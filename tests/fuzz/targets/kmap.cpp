// Kept photon maps. Their checksums, which no mutation would match, are corrected, so that what they protect
// is tested, too.

#include <cstring>
#include <nlohmann/json.hpp>

#include "render/map_files/map_file.h"
#include "render/map_files/map_layout.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

namespace {

void read_map(std::string_view bytes) {
  try {
    const render::MapFile file(input_file("maps.kmap", bytes).string());
    file.open();
    file.check_columns();
    file.photons();
  } catch (const render::MapFileError&) {
  }
}

uint64_t map_word(const std::string& bytes, size_t index) {
  uint64_t word = 0;
  std::memcpy(&word, bytes.data() + index * sizeof word, sizeof word);
  return word;
}

void put_hash(std::string_view of, size_t at, std::string* bytes) {
  const auto words = render::hash_of(std::as_bytes(std::span(of)));
  std::memcpy(bytes->data() + at, words.data(), sizeof words);
}

// The sizes of all arrays, as the manifest names them.
std::vector<uint64_t> array_sizes(std::string_view manifest) {
  std::vector<uint64_t> sizes;
  const auto json = nlohmann::json::parse(manifest, nullptr, false);
  if (!json.is_object() || !json.contains("maps") || !json["maps"].is_array()) return {};
  for (const auto& map : json["maps"]) {
    if (!map.is_object() || !map.contains("bytes") || !map["bytes"].is_array()) return {};
    for (const auto& size : map["bytes"])
      sizes.push_back(size.is_number_unsigned() ? size.get<uint64_t>() : 0);
  }
  return sizes;
}

// Corrects the hashes in the table as far as the arrays lie in the file, then that of the header.
void correct_hashes(std::string* bytes) {
  if (bytes->size() < render::kMapHeadBytes) return;
  const uint64_t text = map_word(*bytes, 2), table = map_word(*bytes, 3);
  const uint64_t left = bytes->size() - render::kMapHeadBytes;
  if (text > left || table > left - text) return;
  const std::string_view all = *bytes;
  const uint64_t table_end = render::kMapHeadBytes + text + table;
  uint64_t begin = table_end, hash = render::kMapHeadBytes + text;
  for (const uint64_t size : array_sizes(all.substr(render::kMapHeadBytes, text))) {
    begin = render::aligned(begin);
    if (begin > all.size() || size > all.size() - begin) break;
    for (uint64_t i = 0; i < size && hash + render::kHashBytes <= table_end; i += render::kHashedChunk) {
      put_hash(all.substr(begin + i, std::min(render::kHashedChunk, size - i)), hash, bytes);
      hash += render::kHashBytes;
    }
    begin += size;
  }
  put_hash(all.substr(render::kMapHeadBytes, text + table), 4 * sizeof(uint64_t), bytes);
}

}  // namespace

void fuzz_kmap(Bytes input) {
  std::string bytes(as_text(input));
  read_map(bytes);
  correct_hashes(&bytes);
  read_map(bytes);
}

}  // namespace kaustik::fuzz
