#include "apps/machine/peak_memory.h"

#include <fstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace kaustik::app {

bool restart_peak_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream file("/proc/self/clear_refs");
  file << "5";
  file.close();
  return bool(file);
}

}  // namespace kaustik::app
