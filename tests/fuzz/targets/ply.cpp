// PLY files, ASCII and binary, also packed by gzip: as meshes of a scene, and as scenes of one mesh.

#include "apps/import/ply/ply.h"

#include "tests/fuzz/scene_input.h"

namespace kaustik::fuzz {

void fuzz_ply(Bytes input) {
  const auto path = input_file("mesh.ply", as_text(input));
  const MeshResult loaded = pbrt::load_ply(ReadableFile::trusted(path));
  check_mesh(loaded);
  load_input_model(path);
}

}  // namespace kaustik::fuzz
