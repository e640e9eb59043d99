#pragma once
#include <stdexcept>

namespace kaustik {

// A file that cannot be opened, read or written. what() is the reason alone, without the file's name.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws FileError with the system's reason for `error`, a value of errno.
[[noreturn]] void throw_file_error(int error);

}  // namespace kaustik
