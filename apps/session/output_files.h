#pragma once
// Files that a command will write: trouble is found before the work starts.

#include <string>

namespace kaustik::app {

// Throws ExitError (bad command line) when no file of this name can be written: its folder is missing or
// read-only, or the name is a folder's. Creates nothing.
void check_writable(const std::string& path);

// check_writable, and the extension must be that of a picture that we write. Throws std::runtime_error where
// its library cannot be loaded.
void check_image_output(const std::string& path);

// Writes a whole text to a temporary name beside `path` and renames it, so that nobody sees half a file.
// Throws std::runtime_error with the path and the system's reason; then nothing is left behind.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace kaustik::app
