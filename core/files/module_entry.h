#pragma once
// Loads the libraries that programs only load when they first need them (cmake/KaustikTargets.cmake,
// kaustik_module).

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace kaustik {

// The function `name` of a library, which lies beside the program or in the installation's library folder:
// the program's run path names both. The library is never closed, since what it made may live as long as the
// process. RTLD_NOW reports missing symbols here rather than at a later call. purpose: "which serves pages",
// for the error. Throws std::runtime_error.
template <class Function>
Function* module_entry(const char* library, const char* name, std::string_view purpose) {
  void* const handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const entry = handle ? dlsym(handle, name) : nullptr;
  if (!entry) throw std::runtime_error(fmt::format("cannot load {}, {}: {}", library, purpose, dlerror()));
  return reinterpret_cast<Function*>(entry);
}

}  // namespace kaustik
