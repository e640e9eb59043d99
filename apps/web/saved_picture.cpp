#include "apps/web/saved_picture.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "apps/command_line/values.h"
#include "apps/web/request_check.h"
#include "core/files/input_file.h"
#include "core/files/temporary_folder.h"
#include "render/film/media_sums.h"
#include "render/picture/exposure.h"
#include "render/picture/image_io.h"

namespace kaustik::app {

namespace {

namespace fs = std::filesystem;

// The bytes of the file that `write` makes.
template <class Write>
std::string bytes_of(const std::string& extension, const Write& write) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / ("picture." + extension);
  write(path.string());
  return read_file(path, fs::file_size(path));
}

std::optional<float> stops_of(const std::string& text) {
  const std::optional<float> stops = parse_number(text);
  return stops && std::abs(*stops) <= float(render::kMostStops) ? stops : std::nullopt;
}

}  // namespace

HttpResponse saved_picture(const LiveRender& live, const HttpRequest& request, const ToneChoice& tone) {
  const std::string format = request.value("format", "exr");
  if (format != "exr" && format != "png") return error_response(400, "format: expected exr or png");
  const render::Film film = live.picture.film();
  const render::Image picture = live.picture.picture();
  render::WriteOptions options;
  options.picture = &picture;
  if (format == "exr") {
    options.layers = render::layers_from_names({"all"});
    std::erase_if(options.layers, render::is_media_layer);  // live pictures do not hold them
  } else {
    const auto tonemap =
        render::tonemap_from_name(request.value("tonemap", std::string(name_of(tone.tonemap))));
    if (!tonemap) return error_response(400, "tonemap: expected srgb, reinhard or filmic");
    std::optional<float> stops = tone.exposure;
    if (const std::string text = request.value("exposure"); !text.empty() && !(stops = stops_of(text)))
      return error_response(400, "exposure: expected a number of stops, -64 to 64");
    if (!stops) stops = render::automatic_exposure(picture, render::lights_seen(film), *tonemap);
    options.tone = {*stops, *tonemap};
  }
  HttpResponse response{
      200, format == "exr" ? "image/x-exr" : "image/png",
      bytes_of(format, [&](const std::string& path) { render::write_film(path, film, options); })};
  const std::string name = fs::path(live.title()).stem().string();
  std::string plain;
  for (const char c : name)
    plain += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
  response.headers.emplace_back(
      "Content-Disposition",
      fmt::format("attachment; filename=\"{}.{}\"", plain.empty() ? "picture" : plain, format));
  return response;
}

}  // namespace kaustik::app
