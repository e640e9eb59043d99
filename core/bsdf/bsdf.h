#pragma once
// The list of all BSDFs. Adding one: (1) a header with the struct, (2) its name here, (3) its row in
// core/scene/schema.cpp.

#include <variant>

#include "core/bsdf/conductor.h"
#include "core/bsdf/dielectric.h"
#include "core/bsdf/lambertian.h"
#include "core/bsdf/mirror.h"
#include "core/bsdf/oren_nayar.h"

namespace kaustik {

using Bsdf = std::variant<Lambertian, OrenNayar, Dielectric, Conductor, Mirror>;

inline bool is_specular(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return std::decay_t<decltype(b)>::kSpecular; }, bsdf);
}
inline Rgb albedo(const Bsdf& bsdf) {
  return std::visit([](const auto& b) { return b.albedo(); }, bsdf);
}

}  // namespace kaustik
