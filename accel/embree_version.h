#pragma once
// Which Embree the program runs with.

#include <string>

namespace kaustik::accel {

// Of the library loaded, which may be newer than the headers: "3.13.5". Throws std::runtime_error when Embree
// gives no device.
std::string embree_version();

}  // namespace kaustik::accel
