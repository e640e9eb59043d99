// glTF scenes: JSON with its buffers in data URIs, or a .glb container.

#include "tests/fuzz/scene_input.h"

namespace kaustik::fuzz {

void fuzz_gltf(Bytes input) {
  load_input_model(input_file("scene.glb", as_text(input)));
}

}  // namespace kaustik::fuzz
