#include "apps/import/common/gzip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

namespace kaustik::pbrt {
namespace {

constexpr size_t kBlock = size_t{4} << 20;

// The memory to unpack a block more: when the string grows, its next capacity, beside its present one. What
// is made of the bytes may take as much again as they do.
uint64_t memory_of_block(const std::string& out) {
  const bool grows = out.size() + kBlock > out.capacity();
  return kBlock + out.size() + (grows ? 2 * out.capacity() : 0);
}

// Owns a zlib inflate stream.
struct Inflater {
  z_stream stream{};
  bool open = false;

  Inflater() { open = inflateInit2(&stream, 16 + MAX_WBITS) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (open) inflateEnd(&stream);
  }
};

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::optional<std::string> unpack_gzip(std::string_view bytes, const MemoryRoom& room, std::string& error) {
  const uint64_t most = std::max(kFreeGzipBytes, kMostGzipRatio * uint64_t{bytes.size()});
  Inflater inflater;
  z_stream& stream = inflater.stream;
  size_t taken = 0;  // bytes handed to the stream; the last avail_in of them are not consumed yet
  std::string out;
  const auto fail = [&](std::string_view what) {
    error = fmt::format("byte {} of the gzip file: {}", taken - stream.avail_in, what);
    return std::nullopt;
  };
  if (!inflater.open) return fail("there is no memory to unpack it");
  while (true) {
    if (stream.avail_in == 0) {
      const size_t part = std::min<size_t>(bytes.size() - taken, std::numeric_limits<int>::max());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
      stream.avail_in = static_cast<uInt>(part);
      taken += part;
    }
    const size_t before = out.size();
    if (before >= most) return fail(fmt::format("it unpacks to more than {} bytes", most));
    if (const std::string lack = room.lacks(memory_of_block(out)); !lack.empty()) return fail(lack);
    out.resize(before + std::min<uint64_t>(kBlock, most - before));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(out.size() - before);
    const int status = inflate(&stream, Z_NO_FLUSH);
    out.resize(out.size() - stream.avail_out);
    const bool all = stream.avail_in == 0 && taken == bytes.size();
    if (status == Z_STREAM_END) {
      if (all) return out;
      if (inflateReset(&stream) != Z_OK) return fail("it is damaged");  // another member follows
    } else if (status == Z_BUF_ERROR && all) {
      return fail("the file ends early");
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      return fail("it is damaged");
    } else if (all && out.size() == before) {
      return fail("the file ends early");
    }
  }
}

}  // namespace kaustik::pbrt
