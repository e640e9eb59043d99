// STL files, ASCII and binary.

#include "apps/import/stl/stl.h"

#include "tests/fuzz/scene_input.h"

namespace kaustik::fuzz {

void fuzz_stl(Bytes input) {
  const auto path = input_file("mesh.stl", as_text(input));
  std::string content;
  check_mesh(load_stl(ReadableFile::trusted(path), &content));
  load_input_model(path);
}

}  // namespace kaustik::fuzz
