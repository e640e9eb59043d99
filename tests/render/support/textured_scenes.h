#pragma once
// Writes scenes with textures as files beside their images.

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <fstream>

#include "apps/import/import_scene.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::test {

// bytes: one or three channels, rows from the top.
inline void write_png(const std::string& name, int width, int channels, const std::vector<uint8_t>& bytes) {
  const int height = int(bytes.size()) / width / channels;
  const std::string path = output_file(name);
  auto out = OIIO::ImageOutput::create(path);
  const OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  if (!out || !out->open(path, spec) || !out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) ||
      !out->close())
    throw std::runtime_error("cannot write " + path);
}

inline Scene scene_of(const std::string& text) {
  const std::string path = output_file("scene.pbrt");
  std::ofstream(path) << text;
  Diagnostics diagnostics;
  auto loaded = pbrt::load_scene(path, diagnostics);
  if (!loaded) throw std::runtime_error(diagnostics.format_all());
  return std::move(loaded->scene);
}

inline std::string rectangle(const std::string& corners, const std::string& more = "") {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point2 uv\" [0 0 1 0 1 1 0 1] "
         "\"point3 P\" [" +
         corners + "] " + more + "\n";
}

}  // namespace kaustik::test
