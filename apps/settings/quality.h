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
  float alpha;
};
// Each has about the error at which more photons or more samples alone would no longer pay.
inline constexpr std::array<QualityPreset, 4> kQualityPresets = {
    {{"draft", 200'000, 4, 0, 1},
     {"medium", 2'000'000, 16, 0, 1},
     {"high", 10'000'000, 64, 4, 1},
     {"reference", 100'000'000, 512, 64, 2.0f / 3}}};

// Its value replaces photons, spp, passes and alpha. Whoever says more than the quality in one place assigns
// the quality first, so that the explicit word holds (SettingOverrides::apply, settings_from_scene).
Setting quality_setting();

}  // namespace kaustik::app
