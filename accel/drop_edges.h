#pragma once
// Drops edges by a test that takes long.

#include <functional>
#include <vector>

#include "core/geometry/boundary_edges.h"
#include "core/parallel/cancellable.h"

namespace kaustik::accel {

// Drops the edges of which drops(edge) is true; the others keep their order. Calls it from several threads.
// go_on, if it is not empty, is called now and then by this thread; where it returns false, all edges stay.
template <class Test>
void drop_edges(std::vector<BoundaryEdge>* edges, const Test& drops,
                const std::function<bool()>& go_on = {}) {
  std::vector<uint8_t> dropped(edges->size());
  const auto test = [&](size_t i) { dropped[i] = drops((*edges)[i]); };
  if (!parallel::for_index_while(go_on, size_t{0}, edges->size(), test)) return;
  size_t kept = 0;
  for (size_t i = 0; i < edges->size(); ++i)
    if (!dropped[i]) (*edges)[kept++] = (*edges)[i];
  edges->resize(kept);
}

}  // namespace kaustik::accel
