#pragma once
// Finds the camera that --camera asks for among those of a scene file.

#include <optional>
#include <string>
#include <vector>

namespace kaustik {

// `names`: of the file's cameras in their order, empty for cameras without a name. `asked`: a name, or a
// number from 1 on; a name counts first. Returns an index into `names`; nothing, with a message in `error`
// that lists the cameras, when there is no such camera.
std::optional<size_t> find_camera(const std::vector<std::string>& names, const std::string& asked,
                                  std::string& error);

}  // namespace kaustik
