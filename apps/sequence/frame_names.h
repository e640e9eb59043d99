#pragma once
// Names of the files of a sequence: one for each frame.

#include <cstdint>
#include <string>

namespace kaustik::app {

// The pattern with the frame's number in place of its one `%d`, or `%04d` for at least four digits.
// std::invalid_argument, with what was expected, for patterns without it or with two.
std::string frame_name(const std::string& pattern, uint64_t frame);

}  // namespace kaustik::app
