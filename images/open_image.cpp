// Knows the formats of images by their first bytes, and opens them with the reader of that format.

#include "images/open_image.h"
#include "core/files/input_file.h"
#include "core/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <string_view>

namespace kaustik::images {

namespace {

using namespace std::string_view_literals;

constexpr size_t kMarkBytes = 16;
constexpr const char* kDamaged = "the file is damaged or truncated";

struct Mark {
  std::string_view bytes, format;
  size_t at = 0;  // offset in the file
};

constexpr Mark kMarks[] = {
    {"\x89PNG\r\n\x1a\n"sv, "png"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"#?"sv, "hdr"},
    {"II*\0"sv, "tiff"},
    {"MM\0*"sv, "tiff"},
    {"II+\0"sv, "tiff"},
    {"MM\0+"sv, "tiff"},
    {"WEBP"sv, "webp", 8},
    {"BM"sv, "bmp"},
};

constexpr std::string_view kFormats = "PNG, JPEG, EXR, HDR, TIFF, PFM and PNM, WebP, Targa and BMP";

// Netpbm's P1 to P6, PF and Pf, each followed by white space.
bool is_netpbm(std::string_view head) {
  return head.size() > 2 && head[0] == 'P' && "123456Ff"sv.find(head[1]) != std::string_view::npos &&
         std::isspace(static_cast<unsigned char>(head[2])) != 0;
}

// Why the reader has failed: its own message, or another in its place, since some readers fail without one.
std::string reason_of(const OIIO::ImageInput& in) {
  std::string reason = in.geterror();
  return reason.empty() ? kDamaged : reason;
}

bool is_targa_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".tga" || extension == ".tpic";
}

}  // namespace

std::string format_of(const std::string& path) {
  std::array<char, kMarkBytes> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view head(bytes.data(), static_cast<size_t>(file.gcount()));
  for (const Mark& mark : kMarks)
    if (head.size() > mark.at && head.substr(mark.at).starts_with(mark.bytes))
      return std::string(mark.format);
  if (is_netpbm(head)) return "pnm";
  return is_targa_name(path) ? "targa" : "";
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path, Reads reads,
                                             OIIO::ImageSpec configuration, std::string& error) {
  const auto fail = [&](std::string why) {
    error = std::move(why);
    return nullptr;
  };
  try {
    check_regular(path);
  } catch (const FileError& failure) {
    return fail(failure.what());
  }
  if (!std::ifstream(path)) return fail(std::strerror(errno));
  const std::string format = format_of(path);
  if (format.empty()) return fail("it is in none of the formats " + std::string(kFormats));
  if (std::string why = damage_of(path, format, reads); !why.empty()) return fail(std::move(why));
  auto in = OIIO::ImageInput::create(format);
  if (!in) return fail(OIIO::geterror());
  in->threads(1);  // otherwise the library starts a thread pool of its own
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  try {
    if (!in->open(path, spec, configuration)) return fail(reason_of(*in));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return fail(kDamaged);
  }
  return in;
}

bool read_channels(OIIO::ImageInput& in, int first, int end, float* values, OIIO::stride_t stride,
                   std::string& error) {
  try {
    if (in.read_image(0, 0, first, end, OIIO::TypeDesc::FLOAT, values, stride)) return true;
    error = reason_of(in);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    error = kDamaged;
  }
  return false;
}

}  // namespace kaustik::images
