#include "apps/machine/instruction_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/highway.h>

#include <vector>

namespace kaustik::app {

std::string instruction_set() {
  const auto targets = hwy::SupportedAndGeneratedTargets();
  const std::string best = targets.empty() ? "scalar" : hwy::TargetName(targets.front());
  std::vector<std::string_view> extensions;
#if defined(__x86_64__) || defined(__i386__)
  if (__builtin_cpu_supports("avx")) extensions.push_back("avx");
  if (__builtin_cpu_supports("fma")) extensions.push_back("fma");
  if (__builtin_cpu_supports("avx2")) extensions.push_back("avx2");
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) extensions.push_back("avx512");
#endif
  return extensions.empty() ? best : fmt::format("{} ({})", best, fmt::join(extensions, " "));
}

}  // namespace kaustik::app
