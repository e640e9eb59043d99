// Scenes in pbrt's text format, from the tokenizer to the built scene. Beside the scene lie a mesh, images, a
// spectrum and a part, which it may name.

#include "render/picture/image_io.h"
#include "tests/fuzz/scene_input.h"

namespace kaustik::fuzz {

namespace {

bool write_named_files() {
  input_file("mesh.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "property float u\nproperty float v\nelement face 2\nproperty list uchar int vertex_indices\n"
             "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0.5 0 1\n3 0 1 2\n3 0 2 3\n");
  input_file("light.spd", "400 0.5\n500 1\n600 0.25\n700 2\n");
  input_file("part.pbrt", "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.25 0.75 ]\nShape \"disk\"\n");
  render::Image image(4, 2);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(0.125f * float(i + 1));
  for (const char* name : {"tiles.png", "light.exr"}) write_image((input_folder() / name).string(), image);
  return true;
}

}  // namespace

void fuzz_pbrt(Bytes input) {
  [[maybe_unused]] static const bool written = write_named_files();
  load_input_scene(input_file("scene.pbrt", as_text(input)));
}

}  // namespace kaustik::fuzz
