#pragma once
// Names of the enumerators in RenderSettings, as they are written on the command line and in scene files,
// metadata and statistics.

#include <array>
#include <optional>
#include <string_view>

#include "render/settings/settings.h"

namespace kaustik::render {

// In the order of the enumerators.
inline constexpr std::array<std::string_view, 5> kMethodNames = {"auto", "raytrace", "mc", "hybrid",
                                                                 "photon"};
inline constexpr std::array<std::string_view, 5> kDirectNames = {"shadow-rays", "photons", "lecture",
                                                                 "predicted", "signed"};
inline constexpr std::array<std::string_view, 4> kCausticNames = {"photons", "paths", "split", "off"};
inline constexpr std::array<std::string_view, 4> kIndirectNames = {"paths", "photons", "split", "off"};
inline constexpr auto kKernelNames = photon::kKernelNames;
inline constexpr std::array<std::string_view, 2> kLookupNames = {"exact", "leaf"};
inline constexpr std::array<std::string_view, 2> kEmissionNames = {"cosine", "uniform-angle"};
inline constexpr std::array<std::string_view, 2> kBalanceNames = {"off", "on"};
inline constexpr std::array<std::string_view, 2> kGuideNames = {"off", "on"};
inline constexpr std::array<std::string_view, 2> kForCameraNames = {"this", "all"};

inline std::string_view name_of(Method m) {
  return kMethodNames[size_t(m)];
}
inline std::string_view name_of(DirectEstimator e) {
  return kDirectNames[size_t(e)];
}
inline std::string_view name_of(CausticEstimator e) {
  return kCausticNames[size_t(e)];
}
inline std::string_view name_of(IndirectEstimator e) {
  return kIndirectNames[size_t(e)];
}
inline std::string_view name_of(Kernel k) {
  return kKernelNames[size_t(k)];
}
inline std::string_view name_of(Lookup l) {
  return kLookupNames[size_t(l)];
}
inline std::string_view name_of(EmissionMode m) {
  return kEmissionNames[size_t(m)];
}
inline std::string_view name_of(Guide g) {
  return kGuideNames[size_t(g)];
}
inline std::string_view name_of(ForCamera f) {
  return kForCameraNames[size_t(f)];
}

// The enumerator of this name, or nothing.
template <class Enum, size_t N>
std::optional<Enum> from_name(const std::array<std::string_view, N>& names, std::string_view name) {
  for (size_t i = 0; i < N; ++i)
    if (names[i] == name) return static_cast<Enum>(i);
  return {};
}

}  // namespace kaustik::render
