#include "apps/machine/instruction_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/highway.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "accel/embree_isa.h"

namespace kaustik::app {

namespace {

bool has(std::string_view isa) {
#if defined(__x86_64__) || defined(__i386__)
  if (isa == "avx512") return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
  if (isa == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return isa == "native";
}

// The Highway target of a pin. Bits of better targets are lower.
int64_t target_of(std::string_view isa) {
  return isa == "avx2" ? HWY_AVX2 : isa == "avx512" ? HWY_AVX3 : 1;
}

}  // namespace

std::string instruction_set() {
  const auto targets = hwy::SupportedAndGeneratedTargets();
  const std::string best = targets.empty() ? "scalar" : hwy::TargetName(targets.front());
  std::vector<std::string_view> extensions;
#if defined(__x86_64__) || defined(__i386__)
  if (__builtin_cpu_supports("avx")) extensions.push_back("avx");
  if (__builtin_cpu_supports("fma")) extensions.push_back("fma");
  if (__builtin_cpu_supports("avx2")) extensions.push_back("avx2");
  if (has("avx512") && pinned_instruction_set() != "avx2") extensions.push_back("avx512");
#endif
  return extensions.empty() ? best : fmt::format("{} ({})", best, fmt::join(extensions, " "));
}

std::string pinned_instruction_set() {
  return accel::embree_isa_limit();
}

void pin_instruction_set(std::string_view name) {
  if (std::ranges::find(kIsaNames, name) == kIsaNames.end())
    throw std::invalid_argument(fmt::format("`{}`: expected one of {}", name, fmt::join(kIsaNames, ", ")));
  if (!has(name) && name != "native")
    throw std::invalid_argument(fmt::format("`{}`: this machine does not have it", name));
  // The C library chooses the same code for all machines with AVX2 and FMA, so it needs no pin.
  hwy::DisableTargets(target_of(name) - 1);
  accel::limit_embree_isa(name == "native" ? std::string() : std::string(name));
}

}  // namespace kaustik::app
