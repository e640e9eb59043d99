#pragma once
// Options of a benchmark program itself, taken out before Google Benchmark parses the rest.

#include <algorithm>
#include <string_view>

namespace kaustik::benchmarks {

// Returns whether the flag is among the arguments, and removes it.
inline bool take_flag(int& argc, char** argv, std::string_view flag) {
  char** const end = std::remove_if(argv + 1, argv + argc, [&](const char* a) { return a == flag; });
  const bool found = end != argv + argc;
  argc = int(end - argv);
  return found;
}

}  // namespace kaustik::benchmarks
