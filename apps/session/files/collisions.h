#pragma once
// Finds outputs of a command that would replace each other, or a file that the command reads.

#include <string>
#include <vector>

namespace kaustik::app {

struct NamedFile {
  std::string option;  // as on the command line, like "--stats"; for inputs a noun, like "the scene"
  std::string path;    // empty = not given
};

// Whether two names mean one file: existing files are compared by device and inode, others by their paths
// without links, `.` and `..`.
bool same_file(const std::string& a, const std::string& b);

// Throws ExitError (bad command line), which names both files, if two outputs are one file or if an output is
// an input.
void check_collisions(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

}  // namespace kaustik::app
