#include "apps/import/common/no_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "apps/import/common/scene_files.h"

namespace kaustik {

namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes, format;
  size_t at = 0;  // offset in the file
};

// Marks that no scene can begin with. `#?` of Radiance files begins a comment of a scene, too.
constexpr std::array kPictures = {
    Mark{"\x89PNG\r\n\x1a\n"sv, "PNG"},
    Mark{"\xff\xd8\xff"sv, "JPEG"},
    Mark{"\x76\x2f\x31\x01"sv, "EXR"},
    Mark{"#?RADIANCE"sv, "HDR"},
    Mark{"#?RGBE"sv, "HDR"},
    Mark{"II*\0"sv, "TIFF"},
    Mark{"MM\0*"sv, "TIFF"},
    Mark{"WEBPVP8"sv, "WebP", 8},
    Mark{"GIF87a"sv, "GIF"},
    Mark{"GIF89a"sv, "GIF"},
    Mark{"8BPS\0"sv, "PSD"},
    Mark{"DDS |\0"sv, "DDS"},
};
constexpr std::string_view kPartialResult = "KPART\r\n\x1a";
constexpr size_t kMarkBytes = 16;

// Netpbm's P1 to P6, PF and Pf, each followed by white space and a number.
bool is_netpbm(std::string_view head) {
  const auto is = [&](size_t i, int (*kind)(int)) { return kind(static_cast<unsigned char>(head[i])) != 0; };
  return head.size() > 3 && head[0] == 'P' && "123456Ff"sv.find(head[1]) != std::string_view::npos &&
         is(2, std::isspace) && is(3, std::isdigit);
}

std::string_view picture_format(std::string_view bytes) {
  for (const Mark& mark : kPictures)
    if (bytes.size() > mark.at && bytes.substr(mark.at).starts_with(mark.bytes)) return mark.format;
  return is_netpbm(bytes) ? "PNM or PFM" : "";
}

}  // namespace

std::string why_no_scene(std::string_view bytes) {
  if (bytes.starts_with(kPartialResult))
    return "it is a partial result of a render, not a scene; `kaustik resume` continues it, and `kaustik "
           "merge` "
           "makes pictures of it";
  const std::string_view format = picture_format(bytes);
  if (format.empty()) return {};
  return fmt::format(
      "it is a picture ({}), not a scene; name the .pbrt, .gltf, .glb, .obj, .ply or .stl file that is to be "
      "rendered. `kaustik compare` and `kaustik denoise` take pictures",
      format);
}

std::string why_no_scene_in(const ReadableFile& file) {
  return why_no_scene(pbrt::first_bytes(file, kMarkBytes));
}

bool is_binary(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  const auto controls = static_cast<size_t>(std::count_if(head.begin(), head.end(), [](char c) {
    return std::iscntrl(static_cast<unsigned char>(c)) != 0 &&
           std::isspace(static_cast<unsigned char>(c)) == 0;
  }));
  return controls >= 8 && 32 * controls > head.size();
}

}  // namespace kaustik
