#pragma once
// Tone mapping from linear radiance to the 8-bit sRGB values of PNG and JPEG files.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik::render {

enum class Tonemap { kSrgb, kReinhard, kFilmic };
inline constexpr std::array<std::string_view, 3> kTonemapNames = {"srgb", "reinhard", "filmic"};

inline std::string_view name_of(Tonemap tonemap) {
  return kTonemapNames[static_cast<size_t>(tonemap)];
}

inline constexpr int kMostStops = 64;  // the largest exposure, either way

struct ToneSettings {
  float exposure = 0;  // stops: radiance is multiplied by 2^exposure
  Tonemap tonemap = Tonemap::kSrgb;

  bool operator==(const ToneSettings&) const = default;
};

// Returns nothing if no operator has this name.
std::optional<Tonemap> tonemap_from_name(std::string_view name);

// Converts radiance to linear display values in [0, 1]: exposure, then the operator. `srgb` clips; `reinhard`
// scales the colour by 1 / (1 + luminance) (Reinhard et al. 2002, eq. 3) and clips; `filmic` is Narkowicz's
// 2015 fit of the ACES curve, per channel. NaN and negative values give 0, +infinity gives 1.
Rgb tonemap(const Rgb& radiance, const ToneSettings& settings);

// The value that `filmic` maps to t, 0 <= t < 1.
double before_filmic(double t);

// Returns tonemap(), encoded and rounded to the nearest of 256 levels.
std::array<uint8_t, 3> to_srgb8(const Rgb& radiance, const ToneSettings& settings);

}  // namespace kaustik::render
