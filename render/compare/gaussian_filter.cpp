#include "render/compare/gaussian_filter.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/parallel.h"

namespace kaustik::render {

std::vector<float> gaussian(int reach, double sigma, double* sum) {
  std::vector<double> values;
  double total = 0;
  for (int x = -reach; x <= reach; ++x) {
    values.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
    total += values.back();
  }
  if (sum) *sum = total;
  std::vector<float> normalised(values.size());
  std::transform(values.begin(), values.end(), normalised.begin(),
                 [=](double v) { return float(v / total); });
  return normalised;
}

void normalise_signs(std::vector<float>* values) {
  double positive = 0, negative = 0;
  for (const float v : *values) (v > 0 ? positive : negative) += double(std::abs(v));
  for (float& v : *values) v = float(double(v) / (v > 0 ? positive : negative));
}

void add_filtered(const std::vector<glm::vec3>& picture, int channel, int width, int height,
                  const std::vector<float>& across, const std::vector<float>& down, float weight,
                  std::vector<glm::vec3>* sum) {
  const auto index = [width](int x, int y) { return size_t(y) * size_t(width) + size_t(x); };
  const int reach_x = int(across.size() / 2), reach_y = int(down.size() / 2);
  std::vector<float> rows(picture.size());
  parallel::for_index(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float total = 0;
      for (int i = -reach_x; i <= reach_x; ++i)
        total += across[size_t(i + reach_x)] * picture[index(std::clamp(x + i, 0, width - 1), y)][channel];
      rows[index(x, y)] = total;
    }
  });
  parallel::for_index(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float total = 0;
      for (int i = -reach_y; i <= reach_y; ++i)
        total += down[size_t(i + reach_y)] * rows[index(x, std::clamp(y + i, 0, height - 1))];
      (*sum)[index(x, y)][channel] += weight * total;
    }
  });
}

}  // namespace kaustik::render
