// Writes and reads EXR files with OpenEXR.

#include "render/picture/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <stdexcept>

#include "core/files/input_file.h"
#include "render/picture/exr_header.h"

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

// Remembers the reason of the file's first failure: the library's messages wrap it in others, and it reports
// nothing when its table of rows, which it writes at the end, fails.
class ExrStream final : public Imf::OStream {
 public:
  explicit ExrStream(PendingFile& file) : OStream("the picture"), file_(file) {}
  void write(const char bytes[], int size) override {
    remember([&] { file_.write(bytes, size_t(size)); });
  }
  uint64_t tellp() override { return file_.position(); }
  void seekp(uint64_t position) override {
    remember([&] { file_.seek(position); });
  }
  // Throws FileError if there was a failure.
  void check() const {
    if (!failure_.empty()) throw FileError(failure_);
  }

 private:
  template <class Work>
  void remember(const Work& work) {
    check();
    try {
      work();
    } catch (const FileError& error) {
      failure_ = error.what();
      throw;
    }
  }

  PendingFile& file_;
  std::string failure_;
};

}  // namespace

void write_exr_file(PendingFile& file, const ExrPicture& picture, const Metadata& attributes) {
  ExrStream stream(file);
  try {
    constexpr int kNoThreads = 0;  // the library makes none; the caller's thread does the work
    Imf::OutputFile out(stream, header_of(picture, attributes), kNoThreads);
    out.setFrameBuffer(buffer_of(picture));
    out.writePixels(picture.height);
  } catch (const std::exception&) {
    stream.check();
    throw;
  }
  stream.check();
}

const std::vector<float>* ExrChannels::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &values[size_t(found - names.begin())];
}

namespace {

// Throws unless the numbers of a file's channels may be kept in memory.
void check_size(int64_t width, int64_t height, const Imf::ChannelList& channels, uint64_t most_pixels) {
  constexpr int64_t kMostSide = 65536, kMostNumbers = int64_t{1} << 32;
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide ||
      uint64_t(width * height) > most_pixels)
    throw std::runtime_error("the picture is too large");
  int64_t count = 0;
  for (auto c = channels.begin(); c != channels.end(); ++c, ++count)
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw std::runtime_error("its channels are subsampled");
  if (count > kMostNumbers / (width * height)) throw std::runtime_error("it has too many channels");
}

}  // namespace

ExrChannels read_exr_file(const std::string& path, uint64_t most_pixels) {
  check_regular(path);
  check_exr_header(path);
  constexpr int kNoThreads = 0;
  Imf::InputFile in(path.c_str(), kNoThreads);
  const Imath::Box2i window = in.header().dataWindow(), display = in.header().displayWindow();
  const int64_t width = int64_t(window.max.x) - window.min.x + 1;
  const int64_t height = int64_t(window.max.y) - window.min.y + 1;
  check_size(width, height, in.header().channels(), most_pixels);
  ExrChannels out{.x0 = window.min.x - display.min.x,
                  .y0 = window.min.y - display.min.y,
                  .width = int(width),
                  .height = int(height),
                  .full_width = display.max.x - display.min.x + 1,
                  .full_height = display.max.y - display.min.y + 1};
  const Imf::ChannelList& channels = in.header().channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    out.names.emplace_back(c.name());
    out.values.emplace_back(size_t(width * height));
  }
  Imf::FrameBuffer buffer;
  for (size_t c = 0; c < out.names.size(); ++c)
    buffer.insert(out.names[c], Imf::Slice::Make(Imf::FLOAT, out.values[c].data(), window, sizeof(float),
                                                 sizeof(float) * size_t(width)));
  in.setFrameBuffer(buffer);
  in.readPixels(window.min.y, window.max.y);
  return out;
}

}  // namespace kaustik::render
