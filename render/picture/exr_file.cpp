// Writes EXR files with OpenEXR.

#include "render/picture/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace kaustik::render {

namespace {

Imath::Box2i data_window(const ExrPicture& p) {
  return {{p.x0, p.y0}, {p.x0 + p.width - 1, p.y0 + p.height - 1}};
}

Imf::Header header_of(const ExrPicture& p, const Metadata& attributes) {
  const Imath::Box2i display({0, 0}, {p.full_width - 1, p.full_height - 1});
  Imf::Header header(display, data_window(p));
  header.compression() = p.zip ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
  for (const std::string& channel : p.channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  for (const auto& [key, value] : attributes) header.insert(key, Imf::StringAttribute(value));
  return header;
}

Imf::FrameBuffer buffer_of(const ExrPicture& p) {
  const size_t pixel = p.channels.size() * sizeof(float), row = pixel * size_t(p.width);
  Imf::FrameBuffer buffer;
  for (size_t c = 0; c < p.channels.size(); ++c)
    buffer.insert(p.channels[c], Imf::Slice::Make(Imf::FLOAT, p.values + c, data_window(p), pixel, row));
  return buffer;
}

void check(const std::ofstream& file) {
  if (!file) throw std::runtime_error(std::strerror(errno));
}

}  // namespace

void write_exr_file(const std::string& path, const ExrPicture& picture, const Metadata& attributes) {
  std::ofstream file(path, std::ios::binary);
  check(file);
  {
    constexpr int kNoThreads = 0;  // the library makes none; the caller's thread does the work
    Imf::StdOFStream stream(file, path.c_str());
    Imf::OutputFile out(stream, header_of(picture, attributes), kNoThreads);
    out.setFrameBuffer(buffer_of(picture));
    out.writePixels(picture.height);
  }
  // The library writes its table of rows at the end and reports no error when that fails.
  file.close();
  check(file);
}

}  // namespace kaustik::render
