#pragma once
// Kernels K(d) of the density estimate on a disc of radius r, each normalised to one over the disc, in 1/m^2.
//
// A kernel is a polynomial in d / R, divided by its integral:
//
//   K(d) = w(d / R) / (N pi r^2)   for d <= r
//   w(x) = sum over j of a_j x^j
//   N    = sum over j of 2 a_j / ((j + 2) k^j)
//
// with R = k r, where k is 1 except for the cone. To add a kernel, add an enumerator and its row in kKernels.
// Everything else follows from the row: the name in command line, scene files and docs, the weights in the
// gather's SIMD lanes, and the share of the kernel's mass behind an edge
// (photon/estimate/boundary_correction.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik::photon {

enum class KernelType : uint8_t { kConstant, kCone, kEpanechnikov };

struct KernelRow {
  static constexpr int kCoefficients = 5;

  KernelType type;
  std::string_view name;               // as the command line spells it
  std::array<float, kCoefficients> a;  // a_0 is 1
  bool stretched = false;              // true: k is KernelSpec::cone_k; false: k is 1

  constexpr int degree() const {
    int last = 0;
    for (int j = 0; j < kCoefficients; ++j)
      if (a[size_t(j)] != 0) last = j;
    return last;
  }
  // Whether only even powers occur; then the weight needs no square root.
  constexpr bool even() const { return a[1] == 0 && a[3] == 0; }
  constexpr int step() const { return even() ? 2 : 1; }  // difference between successive powers in w
};

inline constexpr KernelRow kKernels[] = {
    {KernelType::kConstant, "constant", {1}},
    // Jensen 2001, section 7.2.1 (cone filter).
    {KernelType::kCone, "cone", {1, -1}, true},
    // Silverman 1986, section 4.2.1.
    {KernelType::kEpanechnikov, "epanechnikov", {1, 0, -1}},
};

inline constexpr auto kKernelTypes = [] {
  std::array<KernelType, std::size(kKernels)> types{};
  for (size_t i = 0; i < types.size(); ++i) types[i] = KernelType(i);
  return types;
}();
inline constexpr auto kKernelNames = [] {
  std::array<std::string_view, std::size(kKernels)> names{};
  for (size_t i = 0; i < names.size(); ++i) names[i] = kKernels[i].name;
  return names;
}();
static_assert(
    [] {
      for (const KernelType type : kKernelTypes)
        if (kKernels[size_t(type)].type != type) return false;
      return true;
    }(),
    "the rows are in the order of the enumerators");

struct KernelSpec {
  KernelType type = KernelType::kConstant;
  float cone_k = 1.1f;  // k >= 1: the cone's weight reaches zero at k r

  const KernelRow& row() const { return kKernels[size_t(type)]; }
  float k() const { return row().stretched ? std::max(cone_k, 1.0f) : 1; }
};

// The terms of N: 2 a_j / ((j + 2) k^j).
template <class T>
std::array<T, KernelRow::kCoefficients> mass_terms(const KernelSpec& kernel) {
  std::array<T, KernelRow::kCoefficients> terms{};
  T power = 1;
  for (size_t j = 0; j < terms.size(); ++j, power *= T(kernel.k()))
    terms[j] = 2 * T(kernel.row().a[j]) / (T(j + 2) * power);
  return terms;
}

// The share of the kernel's mass within rho radii of the centre, a polynomial.
class MassWithin {
 public:
  explicit MassWithin(const KernelSpec& kernel) : c_(mass_terms<double>(kernel)) {
    double sum = 0;
    for (const double term : c_) sum += term;
    for (double& term : c_) term /= sum;
  }
  double operator()(double rho) const {  // 0 <= rho <= 1
    double sum = 0;
    for (size_t j = c_.size(); j-- > 0;) sum = sum * rho + c_[j];
    return sum * rho * rho;
  }

 private:
  std::array<double, KernelRow::kCoefficients> c_;
};

// K(d) = scale w, where w is a polynomial in slope s: s is d^2 where the kernel is even(), else d.
struct KernelTerms {
  float scale = 0;  // 1/m^2
  float slope = 0;  // 1/m^2 or 1/m
};

// The terms for a radius in metres. If it is not positive and finite, the kernel is zero, since a disc
// without area has no density.
inline KernelTerms kernel_terms(const KernelSpec& kernel, float radius) {
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  float mass = 0;
  for (const float term : mass_terms<float>(kernel)) mass += term;
  const float area = kPi * radius * radius, reach = kernel.k() * radius;
  return {1 / (mass * area), 1 / (kernel.row().even() ? reach * reach : reach)};
}

// Calls fn.operator()<type>() with the type as a template argument.
template <size_t kFirst = 0, class Fn>
auto with_kernel(KernelType type, const Fn& fn) {
  if constexpr (kFirst + 1 == std::size(kKernels)) {
    return fn.template operator()<KernelType(kFirst)>();
  } else {
    return size_t(type) == kFirst ? fn.template operator()<KernelType(kFirst)>()
                                  : with_kernel<kFirst + 1>(type, fn);
  }
}

// K(d) from the squared distance in m^2, which must not exceed the squared radius. Never negative, though
// rounding could make the polynomial so near the rim.
inline float kernel_value(KernelType type, const KernelTerms& terms, float distance_squared) {
  return with_kernel(type, [&]<KernelType kType>() {
    constexpr KernelRow kRow = kKernels[size_t(kType)];
    const float s = kRow.even() ? distance_squared : std::sqrt(distance_squared);
    float w = kRow.a[size_t(kRow.degree())];
    for (int j = kRow.degree() - kRow.step(); j >= 0; j -= kRow.step())
      w = w * terms.slope * s + kRow.a[size_t(j)];
    return terms.scale * std::max(w, 0.0f);
  });
}

}  // namespace kaustik::photon
