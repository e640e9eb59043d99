#pragma once
// What options of other renderers and programs are called here.

#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

// Long names of the options that do what an option of another program does, `--spp` for `--samples`; none for
// names that are not known. A short name may be followed by its value, as in `-j4`.
std::vector<std::string> names_here(std::string_view other);

}  // namespace kaustik::app
