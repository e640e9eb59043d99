#pragma once
// Reads MTL files, the material libraries of OBJ.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/import/common/counted_warnings.h"
#include "core/files/read_root.h"
#include "core/math/vec.h"

namespace kaustik::obj {

// An image and the options before its name, as in `map_Kd -s 2 2 -o 0.5 0 -clamp on wood.png`.
struct MtlMap {
  std::optional<ReadableFile> file;  // nothing when there is no such file
  SourceLocation where;              // of the name
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  bool clamp = false;
};

// The statements of one material, by lower-case keyword. What is not stated is missing.
struct MtlMaterial {
  std::string name;
  SourceLocation where;
  std::map<std::string, glm::dvec3, std::less<>> colours;  // ka, kd, ks, ke, tf; not negative
  std::map<std::string, double, std::less<>> numbers;      // ns, ni, d, tr, illum, pr, pm
  std::map<std::string, MtlMap, std::less<>>
      maps;  // of map_Kd, map_Ke, map_d, map_Bump, norm, map_Pr, map_Pm

  std::optional<glm::dvec3> colour(std::string_view keyword) const;
  std::optional<double> number(std::string_view keyword) const;
  const MtlMap* map(std::string_view keyword) const;  // null if it is not stated
};

// Whether the first statement of a text is one of material libraries. Of other texts no line may be shown.
bool is_mtl(std::string_view text);

// Reads a library whose text is the file `file` of the diagnostics. Images are looked for in `folders`
// (find_file); one that is missing gives a warning, as do keywords that have no effect here, and one that may
// not be read an error. Values that are no numbers end their statement.
std::vector<MtlMaterial> read_mtl(uint32_t file, std::span<const std::filesystem::path> folders,
                                  CountedWarnings& warnings, Diagnostics& diagnostics);

}  // namespace kaustik::obj
