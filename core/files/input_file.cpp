#include "core/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/files/system_calls.h"

namespace kaustik {

namespace fs = std::filesystem;

namespace {

std::string next_bytes(InputFile& file, uint64_t size) {
  std::string bytes(size, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace

InputFile::InputFile(const fs::path& path) {
  // Without O_NONBLOCK a pipe waits here for its writer; regular files do not know the flag.
  file_ = open_file(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY);
  if (file_ < 0) throw_file_error(errno);
  struct stat status {};
  const int error = ::fstat(file_, &status) == 0 ? 0 : errno;
  if (error == 0 && S_ISREG(status.st_mode)) {
    size_ = static_cast<uint64_t>(status.st_size);
    return;
  }
  close_file(file_);
  if (error != 0) throw_file_error(error);
  throw FileError(kNotRegular);
}

InputFile::~InputFile() {
  close_file(file_);
}

size_t InputFile::read(void* bytes, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t read = read_some(file_, static_cast<char*>(bytes) + done, size - done);
    if (read < 0) throw_file_error(errno);
    if (read == 0) break;
    done += static_cast<size_t>(read);
  }
  return done;
}

void InputFile::rewind() {
  if (::lseek(file_, 0, SEEK_SET) < 0) throw_file_error(errno);
}

std::string read_file(const fs::path& path, uint64_t most_bytes) {
  InputFile file(path);
  if (file.size() > most_bytes) throw FileError(fmt::format("more than {} bytes", most_bytes));
  return next_bytes(file, file.size());
}

std::string read_head(const fs::path& path, size_t size) {
  InputFile file(path);
  return next_bytes(file, std::min<uint64_t>(size, file.size()));
}

}  // namespace kaustik
