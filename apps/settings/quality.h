#pragma once
// --quality: presets of how much work an image is worth. docs/accuracy.md shows what each gives on our
// scenes.

#include <array>

#include "apps/settings/table.h"

namespace kaustik::app {

struct QualityPreset {
  std::string_view name;
  uint64_t photons;
  int spp;
  uint64_t passes;
  float radius_factor;  // of auto's
};
// auto holds the number of photons in reach, and so their noise; with many photons there is room for a wider
// radius, which takes noise away while its blur stays below that of fewer photons.
inline constexpr std::array<QualityPreset, 4> kQualityPresets = {{{"draft", 200'000, 4, 0, 1},
                                                                  {"medium", 1'000'000, 16, 0, 1},
                                                                  {"high", 5'000'000, 64, 0, 2},
                                                                  {"reference", 64'000'000, 1024, 64, 4}}};

// Its value replaces photons, spp, passes and radius. Whoever says more than the quality in one place assigns
// the quality first, so that the explicit word holds (SettingOverrides::apply, settings_from_scene).
Setting quality_setting();

}  // namespace kaustik::app
