#pragma once
// The version of Embree that the program runs with.

#include <string>

namespace kaustik::accel {

// Version of the loaded library, which may be newer than the headers, for example "3.13.5". Throws
// std::runtime_error when Embree provides no device.
std::string embree_version();

}  // namespace kaustik::accel
