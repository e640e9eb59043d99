// The distribution of lights by power.

#include "core/light/light.h"

namespace kaustik {

DiscreteDistribution light_power_distribution(const std::vector<Light>& lights) {
  std::vector<double> weights;
  double total = 0;
  for (const Light& light : lights) {
    weights.push_back(luminance(power(light)));
    total += weights.back();
  }
  if (!(total > 0)) weights.assign(lights.size(), 1.0);
  return DiscreteDistribution(weights);
}

}  // namespace kaustik
