// Writes and reads partial results, with checks of size, version and hash.

#include "render/passes/partial_result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/files/content_hash.h"
#include "core/files/input_file.h"
#include "core/files/pending_file.h"
#include "render/passes/partial_manifest.h"

namespace kaustik::render {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic{"KPART\r\n\x1a", 8};
constexpr uint64_t kVersion = 3;
constexpr uint64_t kHeadBytes = 24, kHashBytes = 16;

// Writes bytes to a file and to the hash that ends the file.
class Writer {
 public:
  explicit Writer(PendingFile& file) : file_(file) {}
  void put(const void* bytes, size_t size) {
    hash_.add(bytes, size);
    file_.write(bytes, size);
  }
  void put(uint64_t word) { put(&word, sizeof word); }
  void put_hash() {
    const auto words = hash_.words();
    file_.write(words.data(), sizeof words);
  }

 private:
  PendingFile& file_;
  ContentHash hash_;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(path) {}
  uint64_t size() const { return file_.size(); }
  void get(void* bytes, size_t size) {
    if (file_.read(bytes, size) != size) fail("the file shrank while it was being read");
  }
  uint64_t word() {
    uint64_t out = 0;
    get(&out, sizeof out);
    return out;
  }
  void rewind() { file_.rewind(); }
  [[noreturn]] void fail(const std::string& message) const { throw PartialError(path_, message); }

 private:
  std::string path_;
  InputFile file_;
};

// Reads the header and returns the size of the manifest.
uint64_t read_head(Reader& in) {
  std::array<char, kMagic.size()> magic{};
  if (in.size() < magic.size()) in.fail("not a partial result of kaustik");
  in.get(magic.data(), magic.size());
  if (std::string_view(magic.data(), magic.size()) != kMagic) in.fail("not a partial result of kaustik");
  if (in.size() < kHeadBytes + kHashBytes) in.fail("the file is truncated: its header is incomplete");
  if (const uint64_t version = in.word(); version != kVersion)
    in.fail(fmt::format("version {} of the format; this program reads version {}", version, kVersion));
  const uint64_t bytes = in.word();
  if (bytes > in.size() - kHeadBytes - kHashBytes)
    in.fail("the file is truncated: its manifest is incomplete");
  return bytes;
}

ReadManifest read_manifest(Reader& in) {
  std::string text(read_head(in), '\0');
  in.get(text.data(), text.size());
  try {
    return manifest_from_text(text);
  } catch (const std::exception& error) {
    in.fail(fmt::format("its manifest is damaged: {}", error.what()));
  }
}

// Checks the hash of the whole file, which is stored in its last bytes.
void check_hash(Reader& in) {
  in.rewind();
  ContentHash hash;
  std::vector<char> block(std::min<uint64_t>(in.size(), 1 << 20));
  for (uint64_t left = in.size() - kHashBytes; left > 0;) {
    const size_t size = std::min<uint64_t>(left, block.size());
    in.get(block.data(), size);
    hash.add(block.data(), size);
    left -= size;
  }
  const uint64_t first = in.word(), second = in.word();
  if (std::array<uint64_t, 2>{first, second} != hash.words())
    in.fail("the file is damaged or truncated: its checksum does not match its contents");
}

PartialResult read_checked(const std::string& path) {
  Reader in(path);
  const uint64_t manifest_bytes = read_head(in);
  check_hash(in);
  in.rewind();
  ReadManifest read = read_manifest(in);
  PassSums& sums = read.result.sums;
  const bool any = !sums.passes.empty();
  const uint64_t pixel_bytes = any ? read.pixel_bytes() : 0;
  if (kHeadBytes + manifest_bytes + pixel_bytes + kHashBytes != in.size())
    in.fail("the file's size does not match its image");
  // The file's size says that its window may be kept in memory, unless it holds no pass.
  sums.totals = any ? read.empty_totals() : FilmTotals({}, read.units);
  for (const std::span<std::byte> pixels : bytes_of(sums.totals)) in.get(pixels.data(), pixels.size());
  return std::move(read.result);
}

std::string seen(const std::vector<std::string>& texts) {
  return texts.empty() ? "unset" : fmt::format("{}", fmt::join(texts, " "));
}

const std::vector<std::string>& find(const SettingTexts& settings, const std::string& name) {
  static const std::vector<std::string> none;
  for (const auto& [n, texts] : settings)
    if (n == name) return texts;
  return none;
}

std::string checked_manifest_text(const PartialManifest& manifest, const PassSums& sums,
                                  const std::string& path) {
  try {
    return manifest_text(manifest, sums);
  } catch (const std::runtime_error& error) {
    throw PartialError(path, error.what());
  }
}

}  // namespace

bool is_partial_name(const std::string& path) {
  return fs::path(path).extension() == ".kpart";
}

void write_partial(const std::string& path, const PartialManifest& manifest, const PassSums& sums) {
  const std::string json = checked_manifest_text(manifest, sums, path);
  try {
    PendingFile file(path);
    Writer out(file);
    out.put(kMagic.data(), kMagic.size());
    out.put(kVersion);
    out.put(json.size());
    out.put(json.data(), json.size());
    if (!sums.passes.empty())
      for (const std::span<const std::byte> pixels : bytes_of(sums.totals))
        out.put(pixels.data(), pixels.size());
    out.put_hash();
    file.commit();
  } catch (const FileError& error) {
    throw PartialError(path, error.what());
  }
}

PartialResult read_partial(const std::string& path) {
  try {
    return read_checked(path);
  } catch (const FileError& error) {
    throw PartialError(path, error.what());
  }
}

std::string difference(const PartialResult& a, const PartialResult& b) {
  const PartialManifest &m = a.manifest, &n = b.manifest;
  if (m.scene_hash != n.scene_hash)
    return fmt::format("they show different scenes: {} and {} differ in content", m.scene_path, n.scene_path);
  for (const auto& [name, texts] : m.settings)
    if (const auto& other = find(n.settings, name); texts != other)
      return fmt::format("they differ in --{}: {} and {}", name, seen(texts), seen(other));
  for (const auto& [name, texts] : n.settings)
    if (find(m.settings, name).empty())
      return fmt::format("they differ in --{}: unset and {}", name, seen(texts));
  if (m.build != n.build)
    return fmt::format("they were made by different programs: {} and {}", m.build, n.build);
  if (m.isa != n.isa)
    return fmt::format(
        "they were made with different instruction sets: {} and {}; with --isa avx2 both machines give the "
        "same "
        "bits",
        m.isa, n.isa);
  if (a.sums.radii && b.sums.radii && *a.sums.radii != *b.sums.radii) return "their gather radii differ";
  if (a.sums.shares != b.sums.shares || a.sums.totals.units() != b.sums.totals.units())
    return "their sums have different units";
  const bool pixels = !a.sums.passes.empty() && !b.sums.passes.empty();
  if (pixels && a.sums.totals.has_halves() != b.sums.totals.has_halves())
    return "only one of them has its samples in halves, for denoising";
  if (pixels && a.sums.totals.has_media() != b.sums.totals.has_media())
    return "only one of them has the layers of media";
  return {};
}

}  // namespace kaustik::render
