#include "apps/command_line/other_names.h"

#include <array>

namespace kaustik::app {

namespace {

struct OtherName {
  std::string_view other;
  std::string_view here, and_here{};
};

// From pbrt, Mitsuba, LuxCoreRender, Blender's Cycles, make, and papers on photon maps.
constexpr std::array kOtherNames = {
    OtherName{"--r0", "--radius"},
    OtherName{"-r", "--radius"},
    OtherName{"--gather-radius", "--radius"},
    OtherName{"-N", "--photons"},
    OtherName{"-n", "--photons"},
    OtherName{"--num-photons", "--photons"},
    OtherName{"--nphotons", "--photons"},
    OtherName{"-k", "--nearest"},
    OtherName{"--knn", "--nearest"},
    OtherName{"--samples", "--spp"},
    OtherName{"--num-samples", "--spp"},
    OtherName{"--samples-per-pixel", "--spp"},
    OtherName{"--pixelsamples", "--spp"},
    OtherName{"--resolution", "--width", "--height"},
    OtherName{"--res", "--width", "--height"},
    OtherName{"--size", "--width", "--height"},
    OtherName{"-w", "--width"},
    OtherName{"--xresolution", "--width"},
    OtherName{"--yresolution", "--height"},
    OtherName{"-j", "--threads"},
    OtherName{"-t", "--threads"},
    OtherName{"--jobs", "--threads"},
    OtherName{"--nthreads", "--threads"},
    OtherName{"--cores", "--threads"},
    OtherName{"--bounces", "--max-bounces"},
    OtherName{"--depth", "--max-bounces"},
    OtherName{"--max-depth", "--max-bounces"},
    OtherName{"--maxdepth", "--max-bounces"},
    OtherName{"--integrator", "--method"},
    OtherName{"--renderer", "--method"},
    OtherName{"--preset", "--quality"},
    OtherName{"--outfile", "--output"},
    OtherName{"--out", "--output"},
    OtherName{"--cropwindow", "--crop"},
    OtherName{"--pixelbounds", "--crop"},
    OtherName{"--region", "--crop"},
    OtherName{"--timeout", "--time"},
    OtherName{"--time-limit", "--time"},
    OtherName{"--max-time", "--time"},
    OtherName{"--noise", "--target-error"},
    OtherName{"--noise-threshold", "--target-error"},
    OtherName{"--environment", "--sky"},
    OtherName{"--envmap", "--sky"},
    OtherName{"--hdri", "--sky"},
    OtherName{"--layers", "--aov"},
};

bool is_short(std::string_view name) {
  return name.size() > 1 && name[1] != '-';
}

}  // namespace

std::vector<std::string> names_here(std::string_view other) {
  if (is_short(other)) other = other.substr(0, 2);
  for (const OtherName& row : kOtherNames) {
    if (row.other != other) continue;
    std::vector<std::string> names = {std::string(row.here)};
    if (!row.and_here.empty()) names.emplace_back(row.and_here);
    return names;
  }
  return {};
}

}  // namespace kaustik::app
