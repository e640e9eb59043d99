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
};
inline constexpr std::array<QualityPreset, 4> kQualityPresets = {{{"draft", 200'000, 4, 0},
                                                                  {"medium", 1'000'000, 16, 0},
                                                                  {"high", 5'000'000, 64, 0},
                                                                  {"reference", 64'000'000, 1024, 64}}};

// Its value replaces photons, spp and passes. Whoever says more than the quality in one place assigns
// the quality first, so that the explicit word holds (SettingOverrides::apply, settings_from_scene).
Setting quality_setting();

}  // namespace kaustik::app
