#pragma once
// Checks and writes output files. The checks run before the work starts.

#include <string>

namespace kaustik::app {

// Throws ExitError (bad command line) when no file of this name can be written: its folder is missing or
// read-only, or the name belongs to a folder, a device or a pipe. Creates nothing.
void check_writable(const std::string& path);

// Like check_writable, and the extension must be one of a supported image format. Throws std::runtime_error
// when the library for that format cannot be loaded.
void check_image_output(const std::string& path);

// Throws ExitError (bad scene) if there is a root (--root) and the file `named_by` names an output outside
// it.
void check_below_root(const std::string& root, const std::string& named_by, const std::string& output);

// Like check_writable, for a file of photon maps, which ends in .kmap.
void check_map_output(const std::string& path);

// The contents of a text file. Throws ExitError (bad command line) with the path and the reason.
std::string text_of_file(const std::string& path);

// Writes a text to a temporary file beside `path` and renames it, so that no incomplete file is ever visible
// under its name. Throws std::runtime_error with the path and the system's reason, and removes the temporary
// file then.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace kaustik::app
