#pragma once
// Means over images and over independent renders, with their standard errors; pictures of failures.

#include <gtest/gtest.h>

#include <string>

#include "render/picture/image_io.h"
#include "tests/render/support/test_scenes.h"
#include "tests/support/output_folder.h"
#include "tests/support/statistics.h"

namespace kaustik::test {

// Mean over all pixels and channels of a layer of light.
inline double layer_mean(const Film& film, Layer layer) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const float* const v = kLayerTable[size_t(layer)].in(film.at(x, y));
      sum += double(v[0]) + double(v[1]) + double(v[2]);
    }
  return sum / (3.0 * film.width() * film.height());
}

inline double total_mean(const Film& film) {
  double sum = 0;
  for (const Layer layer : {Layer::kEmitted, Layer::kDirect, Layer::kCaustic, Layer::kIndirect})
    sum += layer_mean(film, layer);
  return sum;
}

// A file in the test's own folder.
inline std::string output_file(const std::string& name) {
  return (output_folder() / name).string();
}

inline void write_if_failed(const Film& film, const std::string& name) {
  if (!::testing::Test::HasFailure()) return;
  WriteOptions options;
  options.layers = layers_from_names({"all"});
  write_film(output_file(name + ".exr"), film, options);
  write_film(output_file(name + ".png"), film);
}

}  // namespace kaustik::test
