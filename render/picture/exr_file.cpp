// Writes EXR files with OpenEXR.

#include "render/picture/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
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

// A file that remembers the system's reason for its first failure: the library's messages wrap it in others,
// and it reports nothing when its table of rows, which it writes at the end, fails.
class ExrStream final : public Imf::OStream {
 public:
  explicit ExrStream(const std::string& path) : OStream(path.c_str()), file_(path, std::ios::binary) {
    check();
  }
  void write(const char bytes[], int size) override {
    file_.write(bytes, size);
    check();
  }
  uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(file_.tellp())); }
  void seekp(uint64_t position) override {
    file_.seekp(std::streamoff(position));
    check();
  }
  void close() {
    file_.close();
    check();
  }
  // Throws the first failure, if there was one.
  void check() {
    if (!file_ && error_ == 0) error_ = errno != 0 ? errno : EIO;
    if (error_ != 0) throw std::runtime_error(std::strerror(error_));
  }

 private:
  std::ofstream file_;
  int error_ = 0;
};

}  // namespace

void write_exr_file(const std::string& path, const ExrPicture& picture, const Metadata& attributes) {
  ExrStream stream(path);
  try {
    constexpr int kNoThreads = 0;  // the library makes none; the caller's thread does the work
    Imf::OutputFile out(stream, header_of(picture, attributes), kNoThreads);
    out.setFrameBuffer(buffer_of(picture));
    out.writePixels(picture.height);
  } catch (const std::exception&) {
    stream.check();
    throw;
  }
  stream.close();
}

}  // namespace kaustik::render
