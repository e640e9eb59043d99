// OBJ files with their material library. An input holds both: what follows a line `#mtl` is the library
// "scene.mtl".

#include "tests/fuzz/scene_input.h"

namespace kaustik::fuzz {

void fuzz_obj(Bytes input) {
  constexpr std::string_view kSeparator = "#mtl\n";
  const std::string_view text = as_text(input);
  const size_t at = std::min(text.find(kSeparator), text.size());
  input_file("scene.mtl", text.substr(std::min(at + kSeparator.size(), text.size())));
  load_input_model(input_file("scene.obj", text.substr(0, at)));
}

}  // namespace kaustik::fuzz
