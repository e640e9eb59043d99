#include "core/files/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/files/system_calls.h"

namespace kaustik {

namespace {

std::string next_bytes(InputFile& file, uint64_t size) {
  std::string bytes(size, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace

InputFile::InputFile(const ReadableFile& file) {
  // Without O_NONBLOCK a pipe waits here for its writer; regular files do not know the flag.
  constexpr int kFlags = O_RDONLY | O_NONBLOCK | O_NOCTTY;
  const char* const path = file.place().c_str();
  file_ = file.without_links() ? open_without_links(path, kFlags) : open_file(path, kFlags);
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

std::string read_file(const ReadableFile& readable, uint64_t most_bytes) {
  InputFile file(readable);
  if (file.size() > most_bytes) throw FileError(fmt::format("more than {} bytes", most_bytes));
  // What is made of the bytes may take as much again.
  if (std::string lack = readable.room().lacks(2 * file.size()); !lack.empty()) throw FileError(lack);
  return next_bytes(file, file.size());
}

std::string read_head(const ReadableFile& readable, size_t size) {
  InputFile file(readable);
  return next_bytes(file, std::min<uint64_t>(size, file.size()));
}

}  // namespace kaustik
