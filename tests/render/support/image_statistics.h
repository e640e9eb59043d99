#pragma once
// Means over images and over independent renders, with their standard errors; pictures of failures.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "render/picture/image_io.h"
#include "tests/render/support/test_scenes.h"

namespace kaustik::render::test {

struct Estimate {
  double mean = 0, standard_error = 0;
};

inline Estimate estimate_of(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double mean = sum / double(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / double(values.size() - 1) / double(values.size()))};
}

// Mean over all pixels and channels of one class of paths (Layer::kEmitted to kIndirect).
inline double layer_mean(const Film& film, Layer layer) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const PixelResult& p = film.at(x, y);
      const Rgb v = layer == Layer::kEmitted   ? p.emitted
                    : layer == Layer::kDirect  ? p.direct
                    : layer == Layer::kCaustic ? p.caustic
                                               : p.indirect;
      sum += double(v.x) + double(v.y) + double(v.z);
    }
  return sum / (3.0 * film.width() * film.height());
}

inline double total_mean(const Film& film) {
  double sum = 0;
  for (const Layer layer : {Layer::kEmitted, Layer::kDirect, Layer::kCaustic, Layer::kIndirect})
    sum += layer_mean(film, layer);
  return sum;
}

// Where a failing test leaves its picture.
// In a folder of the test's own: tests run side by side.
inline std::string output_file(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string folder = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(folder.begin(), folder.end(), '/', '_');
  const auto path = std::filesystem::path(KAUSTIK_TEST_OUTPUT_DIR) / folder;
  std::filesystem::create_directories(path);
  return (path / name).string();
}

inline void write_if_failed(const Film& film, const std::string& name) {
  if (!::testing::Test::HasFailure()) return;
  WriteOptions options;
  options.layers = layers_from_names({"all"});
  write_film(output_file(name + ".exr"), film, options);
  write_film(output_file(name + ".png"), film);
}

}  // namespace kaustik::render::test
