#pragma once
// The energy that the processors have used, where the system tells it: RAPL (powercap).

#include <optional>
#include <string>
#include <vector>

namespace kaustik::app {

class EnergyMeter {
 public:
  // `root`: a prefix of /sys, for tests.
  explicit EnergyMeter(const std::string& root = "");
  // Joules of all processors since the construction, those of other programs included. Nothing where a
  // counter cannot be read: most systems let only root do it, and most virtual machines nobody. Counters wrap
  // around; ask at least once a minute.
  std::optional<double> joules();

 private:
  struct Counter {
    std::string folder;
    double last = 0, range = 0;  // microjoules
  };
  std::vector<Counter> counters_;
  double joules_ = 0;
};

}  // namespace kaustik::app
