// Tone mapping operators and the sRGB transfer curve.

#include "render/picture/tonemap.h"
#include "core/spectrum/srgb.h"

namespace kaustik::render {

namespace {

// Clamps to [0, 1]; NaN gives 0.
float clip(float v) {
  return v > 0 ? std::min(v, 1.0f) : 0.0f;
}

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": (a x^2 + b x) / (c x^2 + d x + e), written as a ratio
// that stays finite for large x.
constexpr float kA = 2.51f, kB = 0.03f, kC = 2.43f, kD = 0.59f, kE = 0.14f;

float filmic(float x) {
  if (!(x > 0)) return 0;
  if (x > 1e6f) return 1;
  return clip(x * (kA * x + kB) / (x * (kC * x + kD) + kE));
}

}  // namespace

std::optional<Tonemap> tonemap_from_name(std::string_view name) {
  for (size_t i = 0; i < kTonemapNames.size(); ++i)
    if (kTonemapNames[i] == name) return static_cast<Tonemap>(i);
  return {};
}

Rgb tonemap(const Rgb& radiance, const ToneSettings& settings) {
  const Rgb c = radiance * std::exp2(settings.exposure);
  switch (settings.tonemap) {
    case Tonemap::kReinhard: {
      const float Y = luminance(c);
      if (!std::isfinite(Y)) break;
      const float scale = 1 / (1 + std::max(Y, 0.0f));
      return {clip(c.x * scale), clip(c.y * scale), clip(c.z * scale)};
    }
    case Tonemap::kFilmic:
      return {filmic(c.x), filmic(c.y), filmic(c.z)};
    case Tonemap::kSrgb:
      break;
  }
  return {clip(c.x), clip(c.y), clip(c.z)};
}

// The positive root of (a - c t) x^2 + (b - d t) x - e t.
double before_filmic(double t) {
  const double a = double(kA) - t * double(kC), b = double(kB) - t * double(kD), c = -t * double(kE);
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

std::array<uint8_t, 3> to_srgb8(const Rgb& radiance, const ToneSettings& settings) {
  const Rgb display = tonemap(radiance, settings);
  std::array<uint8_t, 3> out;
  for (int c = 0; c < 3; ++c) out[size_t(c)] = uint8_t(std::floor(srgb_from_linear(display[c]) * 255 + 0.5f));
  return out;
}

}  // namespace kaustik::render
