#pragma once
// Which instructions Embree may use.

#include <string>

namespace kaustik::accel {

// Devices that are opened from now on use no more than these: "avx2", "avx512"; empty: all that the machine
// has. State of the process, as Embree's own choice is; call it before threads use Embree.
void limit_embree_isa(const std::string& isa);

const std::string& embree_isa_limit();

}  // namespace kaustik::accel
