#pragma once
// The setting --quality: presets of photons, samples and passes. docs/accuracy.md shows their results on the
// scenes of this repository.

#include <array>

#include "apps/settings/table/table.h"

namespace kaustik::app {

struct QualityPreset {
  std::string_view name;
  uint64_t photons;
  int spp;
  uint64_t passes;
  bool unbiased = false;  // paths do not end early
};
inline constexpr std::array<QualityPreset, 4> kQualityPresets = {{{"draft", 500'000, 4, 0},
                                                                  {"medium", 4'000'000, 8, 0},
                                                                  {"high", 16'000'000, 32, 0},
                                                                  {"reference", 64'000'000, 1024, 64, true}}};

// Assigning it replaces photons, spp, the balance of both, passes and final_gather. Callers assign the
// quality before other settings from the same source, so that explicit values win (SettingOverrides::apply,
// settings_from_scene).
Setting quality_setting();

}  // namespace kaustik::app
