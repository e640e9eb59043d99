#pragma once
// Pearson's chi-square test of a sampler against the density that it claims.

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "tests/support/random.h"

namespace kaustik::test {

// Upper tail of the chi-square distribution by Wilson and Hilferty's (1931) cube-root normal approximation.
// Its error is far below the significance used here for 10 and more degrees of freedom.
inline double chi_square_p_value(double statistic, int degrees) {
  const double k = 2.0 / (9 * degrees);
  const double z = (std::cbrt(statistic / degrees) - (1 - k)) / std::sqrt(k);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

// Significance of each of `tests` independent tests that keeps the chance of any false alarm at 0.01 (Sidak
// 1967).
inline double sidak_significance(size_t tests) {
  return 1 - std::pow(1 - 0.01, 1.0 / static_cast<double>(tests));
}

// A sampler with values in the unit square, and the density that it claims. Samples without a value are
// counted in a bin of their own.
struct SquareCase {
  std::string name;
  std::function<bool(Random&, Point2*)> sample;
  std::function<double(double x, double y)> density;
  int subdivisions = 4;  // per axis and bin, to integrate the density; more where it jumps inside a bin
};

struct ChiSquareResult {
  double p_value = 0;
  double expected_mass = 0;  // integral of the density: at most one
  int64_t outside = 0;       // samples outside the square
};

// Evaluates the density at one point in each of subdivisions^2 cells of a bin: at its middle for smooth
// densities, at a random place where there are many cells, since an outline that runs along the cells would
// bias every bin that it crosses.
inline double integrate_bin(const SquareCase& c, int x, int y, int bins, Random& random) {
  const bool jitter = c.subdivisions > 8;
  const double h = 1.0 / (bins * c.subdivisions);
  double sum = 0;
  for (int j = 0; j < c.subdivisions; ++j) {
    for (int i = 0; i < c.subdivisions; ++i) {
      const double dx = jitter ? random.uniform() : 0.5;
      const double dy = jitter ? random.uniform() : 0.5;
      sum += c.density((x * c.subdivisions + i + dx) * h, (y * c.subdivisions + j + dy) * h) * h * h;
    }
  }
  return sum;
}

// Pools bins with fewer than `kLeast` expected samples, as the test's approximation demands.
inline double pooled_p_value(const std::vector<double>& expected, const std::vector<int64_t>& observed) {
  constexpr double kLeast = 10;
  double statistic = 0, pooled_expected = 0;
  int64_t pooled_observed = 0;
  int used = 0;
  const auto add = [&](double e, int64_t o) {
    const double d = static_cast<double>(o) - e;
    statistic += d * d / e;
    ++used;
  };
  for (size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] >= kLeast) {
      add(expected[i], observed[i]);
    } else {
      pooled_expected += expected[i];
      pooled_observed += observed[i];
    }
  }
  if (pooled_expected >= kLeast) {
    add(pooled_expected, pooled_observed);
  } else if (static_cast<double>(pooled_observed) > pooled_expected + 8 * std::sqrt(pooled_expected + 1)) {
    return 0;  // many samples where the density is next to zero
  }
  return chi_square_p_value(statistic, used - 1);
}

inline ChiSquareResult chi_square_test(const SquareCase& c, int64_t samples, uint64_t seed, int bins = 16) {
  ChiSquareResult result;
  std::vector<int64_t> observed(static_cast<size_t>(bins) * bins + 1, 0);
  std::vector<double> expected(observed.size(), 0);
  Random random(seed);
  for (int y = 0; y < bins; ++y) {
    for (int x = 0; x < bins; ++x) {
      const double mass = integrate_bin(c, x, y, bins, random);
      expected[static_cast<size_t>(y) * bins + x] = mass * static_cast<double>(samples);
      result.expected_mass += mass;
    }
  }
  expected.back() = std::max(0.0, 1 - result.expected_mass) * static_cast<double>(samples);
  for (int64_t i = 0; i < samples; ++i) {
    Point2 p;
    if (!c.sample(random, &p)) {
      ++observed.back();
      continue;
    }
    if (!(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1)) {
      ++result.outside;
      continue;
    }
    const int x = std::min(bins - 1, static_cast<int>(p.x * bins));
    const int y = std::min(bins - 1, static_cast<int>(p.y * bins));
    ++observed[static_cast<size_t>(y) * bins + x];
  }
  result.p_value = pooled_p_value(expected, observed);
  return result;
}

// Runs every case and expects that none is rejected, that no sample leaves the square, and that every density
// integrates to least_mass..1 up to the quadrature's error.
void expect_all_accepted(const std::vector<SquareCase>& cases, int64_t samples, double mass_tolerance,
                         double least_mass = 1);

// Maps directions to the unit square: x = (z - z_min) / (1 - z_min), y = azimuth / (2 pi). 1 - z comes from
// the sine, which keeps its precision in thin cones.
inline Point2 direction_to_square(const Vector3& local, double z_min) {
  const glm::dvec3 w(local);
  const double one_minus_z = w.z > 0 ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z;
  const double turns = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
  return Point2(glm::dvec2(1 - one_minus_z / (1 - z_min), turns < 0 ? turns + 1 : turns));
}
inline Vector3 square_to_direction(double x, double y, double z_min) {
  const double z = z_min + x * (1 - z_min);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  const double phi = 2 * std::numbers::pi * y;
  return Vector3(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
}
// Solid angle that the whole square stands for.
inline double square_solid_angle(double z_min) {
  return 2 * std::numbers::pi * (1 - z_min);
}

}  // namespace kaustik::test
