#pragma once
// Drops edges by a test that takes long.

#include <vector>

#include "core/geometry/boundary_edges.h"
#include "core/parallel/parallel.h"

namespace kaustik::accel {

// Drops the edges of which drops(edge) is true; the others keep their order. Calls it from several threads.
template <class Test>
void drop_edges(std::vector<BoundaryEdge>* edges, const Test& drops) {
  std::vector<uint8_t> dropped(edges->size());
  parallel::for_index(size_t{0}, edges->size(), [&](size_t i) { dropped[i] = drops((*edges)[i]); });
  size_t kept = 0;
  for (size_t i = 0; i < edges->size(); ++i)
    if (!dropped[i]) (*edges)[kept++] = (*edges)[i];
  edges->resize(kept);
}

}  // namespace kaustik::accel
