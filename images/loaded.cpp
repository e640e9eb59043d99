// image_formats() for programs, which load OpenImageIO when it is first needed. The library lies beside
// the program or in the installation's library folder; a program's run path names it
// (images/CMakeLists.txt, apps/CMakeLists.txt).

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "render/picture/image_formats.h"

namespace kaustik::render {

namespace {

// The library is never closed, since objects that it made may live as long as the process. RTLD_NOW reports
// missing symbols here rather than at a later call.
const ImageFormats& load() {
  const auto fail = [] {
    return std::runtime_error(
        fmt::format("cannot load {}, which reads and writes image files other than EXR: {}",
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
