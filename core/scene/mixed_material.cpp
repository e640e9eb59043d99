// The choice between the two materials of a mixture.

#include "core/scene/mixed_material.h"

#include <bit>

#include "core/sampling/sampler.h"

namespace kaustik {

namespace {

uint64_t with_bits_of(uint64_t hash, const glm::vec3& v, uint32_t mask) {
  for (int c = 0; c < 3; ++c) hash = hash_combine(hash, std::bit_cast<uint32_t>(v[c]) & mask);
  return hash;
}

}  // namespace

uint32_t MixedMaterial::choose(const Point3& p, const Vector3& wo, float share) const {
  constexpr uint32_t kSignAndMantissa = 0x807fffff, kAll = 0xffffffff;
  const uint64_t of_materials = hash_combine(first, second);
  const uint64_t hash = with_bits_of(with_bits_of(of_materials, p, kSignAndMantissa), wo, kAll);
  return unit_number(hash) < share ? second : first;
}

}  // namespace kaustik
