#pragma once
// How long this process's threads were ready to run while other programs had the cores.

#include <optional>
#include <string>

namespace kaustik::app {

// Seconds, summed over the threads that there are now (proc(5), schedstat). Nothing where the kernel does not
// count them. `root`: a prefix of /proc, for tests.
std::optional<double> waiting_seconds(const std::string& root = "");

}  // namespace kaustik::app
