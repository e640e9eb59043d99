#include "core/files/pending_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/files/hidden_name.h"
#include "core/files/system_calls.h"

namespace kaustik {

namespace fs = std::filesystem;

namespace {

constexpr size_t kBufferBytes = 1 << 16;
constexpr std::string_view kEnding = ".partial";
constexpr size_t kRandomDigits = 16;

fs::path new_temporary_name(const fs::path& path) {
  uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random) throw_file_error(errno);
  return path.parent_path() / fmt::format("{}{:016x}{}", hidden_name_beginning(path), random, kEnding);
}

// Whether files without a name can later be named, for which /proc must be there.
bool can_be_named_later() {
  static const bool there = ::access("/proc/self/fd", X_OK) == 0;
  return there;
}

// The hidden_name_beginning() of a name that new_temporary_name() may have made; empty for other names.
std::string_view beginning_of_temporary(std::string_view name) {
  if (!name.ends_with(kEnding)) return {};
  name.remove_suffix(kEnding.size());
  const size_t digits = name.size() - std::min(name.size(), kRandomDigits);
  if (name.find_first_not_of("0123456789abcdef", digits) != name.npos) return {};
  name = name.substr(0, digits);
  return name.size() > 2 && name.starts_with('.') && name.ends_with('.') ? name : std::string_view();
}

// Removes the temporary files in the folder for whose beginnings `is_chosen` holds.
template <class IsChosen>
void remove_temporaries(const fs::path& folder, const IsChosen& is_chosen) {
  std::error_code error;
  for (fs::directory_iterator i(folder.empty() ? "." : folder, error), end; !error && i != end;
       i.increment(error)) {
    const std::string name = i->path().filename().string();
    const std::string_view beginning = beginning_of_temporary(name);
    std::error_code ignored;
    if (!beginning.empty() && is_chosen(beginning)) fs::remove(i->path(), ignored);
  }
}

}  // namespace

void throw_file_error(int error) {
  throw FileError(std::strerror(error));
}

PendingFile::PendingFile(fs::path final_name)
    : final_(std::move(final_name)), temporary_(new_temporary_name(final_)) {
  buffer_.reserve(kBufferBytes);
  open();
}

void PendingFile::open() {
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  if (can_be_named_later()) file_ = open_file(folder.c_str(), O_TMPFILE | O_WRONLY);
  // Overlays and network file systems give other reasons than EOPNOTSUPP; one that matters comes again.
  if (file_ >= 0) return;
  file_ = open_file(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (file_ < 0) throw_file_error(errno);
  named_ = true;
}

PendingFile::~PendingFile() {
  if (file_ >= 0) close_file(file_);
  if (named_) ::unlink(temporary_.c_str());
}

void PendingFile::write(const void* bytes, size_t size) {
  if (buffer_.size() + size > kBufferBytes) flush();
  const auto* const first = static_cast<const char*>(bytes);
  if (size > kBufferBytes)
    write_through(first, size);
  else
    buffer_.insert(buffer_.end(), first, first + size);
  position_ += size;
  size_ = std::max(size_, position_);
}

void PendingFile::write_through(const char* bytes, size_t size) {
  while (size > 0) {
    const ssize_t written = write_some(file_, bytes, size);
    if (written <= 0) throw_file_error(written < 0 ? errno : EIO);
    bytes += written;
    size -= static_cast<size_t>(written);
  }
}

void PendingFile::seek(uint64_t position) {
  flush();
  if (::lseek(file_, static_cast<off_t>(position), SEEK_SET) < 0) throw_file_error(errno);
  position_ = position;
}

void PendingFile::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void PendingFile::close() {
  const int file = std::exchange(file_, -1);
  // Some file systems, NFS among them, report only here that the disk is full.
  if (close_file(file) != 0) throw_file_error(errno);
}

void PendingFile::complete() {
  flush();
  if (sync_file(file_) != 0) throw_file_error(errno);
  struct stat status {};
  if (::fstat(file_, &status) != 0) throw_file_error(errno);
  if (static_cast<uint64_t>(status.st_size) != size_) throw FileError("the file has lost some of its bytes");
}

void PendingFile::wait_under_temporary_name() {
  if (!named_ && name_file(file_, temporary_.c_str()) != 0) throw_file_error(errno);
  named_ = true;
  close();
}

void PendingFile::finish() {
  complete();
  wait_under_temporary_name();
}

void PendingFile::commit() {
  if (file_ >= 0) {
    complete();
    if (!named_) {
      if (name_file(file_, final_.c_str()) == 0) return close();
      // The system has no call that names an open file and replaces another one.
      if (errno != EEXIST) throw_file_error(errno);
    }
    wait_under_temporary_name();
  }
  if (rename_file(temporary_.c_str(), final_.c_str()) != 0) throw_file_error(errno);
  named_ = false;
}

void write_file(const fs::path& path, std::string_view bytes) {
  PendingFile file(path);
  file.write(bytes);
  file.commit();
}

void remove_leftovers(const fs::path& path) {
  const std::string of_path = hidden_name_beginning(path);
  remove_temporaries(path.parent_path(), [&](std::string_view beginning) { return beginning == of_path; });
}

void remove_all_leftovers(const fs::path& folder) {
  remove_temporaries(folder, [](std::string_view) { return true; });
}

}  // namespace kaustik
