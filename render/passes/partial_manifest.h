#pragma once
// Conversion of a partial result's manifest to and from the text of a JSON object.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "render/passes/partial_result.h"

namespace kaustik::render {

// Throws std::runtime_error for a file name that is not UTF-8, as JSON must be.
std::string manifest_text(const PartialManifest& manifest, const PassSums& sums);

// A manifest as read: everything but the pixels, of which only the window is known.
struct ReadManifest {
  PartialResult result;  // without pixels
  ExactUnits units;
  bool halves = false, media = false;
  int width = 0, height = 0, x0 = 0, y0 = 0, full_width = 0, full_height = 0;

  FilmTotals empty_totals() const;  // totals of zero for this window
  uint64_t pixel_bytes() const;     // of all pixels, see bytes_of()
};
// Throws std::runtime_error, or the JSON library's exceptions, if a value is missing or invalid.
ReadManifest manifest_from_text(std::string_view text);

// The pixels of sums as they are written: PixelTotals, then HalfTotals and MediaTotals, which may be none.
std::array<std::span<std::byte>, 3> bytes_of(FilmTotals& totals);
std::array<std::span<const std::byte>, 3> bytes_of(const FilmTotals& totals);

}  // namespace kaustik::render
