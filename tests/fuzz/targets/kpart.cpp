// Partial results. Their checksum, which no mutation would match, is corrected, so that what it protects is
// tested, too.

#include "core/files/content_hash.h"
#include "render/passes/partial_result.h"
#include "tests/fuzz/input_folder.h"

namespace kaustik::fuzz {

namespace {

void read_part(std::string_view bytes) {
  try {
    const render::PartialResult part = render::read_partial(input_file("part.kpart", bytes).string());
    if (!render::difference(part, part).empty()) throw Violation("a part differs from itself");
    if (part.sums.passes.empty()) return;
    part.sums.totals.mean();
    if (part.sums.totals.has_halves()) part.sums.totals.halves();
  } catch (const render::PartialError&) {
  }
}

}  // namespace

void fuzz_kpart(Bytes input) {
  std::string bytes(as_text(input));
  read_part(bytes);
  constexpr size_t kHash = 16;
  if (bytes.size() < kHash) return;
  ContentHash hash;
  hash.add(std::string_view(bytes).substr(0, bytes.size() - kHash));
  const auto words = hash.words();
  bytes.replace(bytes.size() - kHash, kHash, reinterpret_cast<const char*>(words.data()), kHash);
  read_part(bytes);
}

}  // namespace kaustik::fuzz
