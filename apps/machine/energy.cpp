#include "apps/machine/energy.h"

#include <filesystem>
#include <fstream>

namespace kaustik::app {

namespace {

namespace fs = std::filesystem;

std::optional<double> number_in(const std::string& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

// A package, not one of its parts: "intel-rapl:0", which processors of AMD have as well.
bool is_package(const std::string& name) {
  return name.starts_with("intel-rapl:") && name.find(':') == name.rfind(':');
}

}  // namespace

EnergyMeter::EnergyMeter(const std::string& root) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(root + "/sys/class/powercap", error)) {
    if (!is_package(entry.path().filename().string())) continue;
    const std::string folder = entry.path().string() + "/";
    const auto now = number_in(folder + "energy_uj"), range = number_in(folder + "max_energy_range_uj");
    if (now && range) counters_.push_back({folder, *now, *range});
  }
}

std::optional<double> EnergyMeter::joules() {
  if (counters_.empty()) return std::nullopt;
  for (Counter& counter : counters_) {
    const auto now = number_in(counter.folder + "energy_uj");
    if (!now) return std::nullopt;
    joules_ += 1e-6 * (*now - counter.last + (*now < counter.last ? counter.range : 0));
    counter.last = *now;
  }
  return joules_;
}

}  // namespace kaustik::app
