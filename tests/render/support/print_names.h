#pragma once
// Lets GoogleTest print the choices of RenderSettings by their names, in the names of tests and in failures.

#include <concepts>
#include <ostream>

#include "render/settings/names.h"

namespace kaustik::render {

template <class Enum>
concept Named = requires(Enum e) {
  { name_of(e) } -> std::same_as<std::string_view>;
};

template <Named Enum>
void PrintTo(const Enum& e, std::ostream* out) {
  *out << name_of(e);
}

}  // namespace kaustik::render
