#pragma once
// Drops edges by a test that takes long.

#include <algorithm>
#include <functional>
#include <vector>

#include "core/geometry/boundary_edges.h"
#include "core/parallel/parallel.h"

namespace kaustik::accel {

// Drops the edges of which drops(edge) is true; the others keep their order. Calls it from several threads.
// go_on, if it is not empty, is called now and then by this thread; where it returns false, all edges stay.
template <class Test>
void drop_edges(std::vector<BoundaryEdge>* edges, const Test& drops,
                const std::function<bool()>& go_on = {}) {
  constexpr size_t kAtATime = 1 << 14;
  std::vector<uint8_t> dropped(edges->size());
  for (size_t begin = 0; begin < edges->size(); begin += kAtATime) {
    if (go_on && !go_on()) return;
    parallel::for_index(begin, std::min(begin + kAtATime, edges->size()),
                        [&](size_t i) { dropped[i] = drops((*edges)[i]); });
  }
  size_t kept = 0;
  for (size_t i = 0; i < edges->size(); ++i)
    if (!dropped[i]) (*edges)[kept++] = (*edges)[i];
  edges->resize(kept);
}

}  // namespace kaustik::accel
