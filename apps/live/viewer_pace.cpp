#include "apps/live/viewer_pace.h"

#include "apps/machine/usable_cores.h"

namespace kaustik::app {

double rest_after(double processor_seconds) {
  static const int cores = core_limits().usable();
  return processor_seconds / (kViewerShare * cores);
}

}  // namespace kaustik::app
