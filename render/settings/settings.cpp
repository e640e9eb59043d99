#include "render/settings/settings.h"

#include <algorithm>

namespace kaustik::render {

bool names_denoising(const std::vector<std::string>& aov) {
  return std::find(aov.begin(), aov.end(), kDenoisingLayers) != aov.end();
}

bool keeps_halves(const RenderSettings& settings) {
  return settings.denoise.value_or(false) || names_denoising(settings.aov);
}

}  // namespace kaustik::render
