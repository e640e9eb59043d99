// Loaded when it is first asked for: for the program. The library lies beside the program or where the
// installation puts it; the program's run path, relative to itself, says where (apps/CMakeLists.txt).

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "render/picture/image_formats.h"

namespace kaustik::render {

namespace {

// Never closed: what it made may live as long as the process. RTLD_NOW: what does not fit is found here.
const ImageFormats& load() {
  const auto fail = [] {
    return std::runtime_error(
        fmt::format("cannot load {}, which reads and writes pictures other than EXR: {}",
                    KAUSTIK_IMAGES_MODULE, dlerror()));
  };
  void* const library = dlopen(KAUSTIK_IMAGES_MODULE, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw fail();
  void* const entry = dlsym(library, "kaustik_image_formats");
  if (!entry) throw fail();
  return *reinterpret_cast<const ImageFormats* (*)()>(entry)();
}

}  // namespace

const ImageFormats& image_formats() {
  static const ImageFormats& formats = load();
  return formats;
}

}  // namespace kaustik::render
