#pragma once
// Separable filters over pictures; the border's pixels repeat beyond it.

#include <vector>

#include "core/math/vec.h"

namespace kaustik::render {

// The values of exp(-x^2 / (2 sigma^2)) at whole x from -reach to reach, divided by their sum; sigma in
// pixels. sum: if not null, receives that sum.
std::vector<float> gaussian(int reach, double sigma, double* sum = nullptr);

// Divides the positive values by their sum and the negative ones by theirs.
void normalise_signs(std::vector<float>* values);

// Adds weight times one channel of the picture, filtered along rows by `across` and along columns by `down`,
// to that channel of *sum. Both filters have an odd length.
void add_filtered(const std::vector<glm::vec3>& picture, int channel, int width, int height,
                  const std::vector<float>& across, const std::vector<float>& down, float weight,
                  std::vector<glm::vec3>* sum);

}  // namespace kaustik::render
