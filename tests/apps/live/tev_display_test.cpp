// --display: the bytes of tev's protocol, and pictures that arrive bit by bit at viewers of all manners.

#include "apps/live/tev_display.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "apps/live/tev_protocol.h"
#include "tests/apps/live/support/test_viewer.h"

namespace kaustik::app {
namespace {

using render::PixelRange;
using test::Manners;
using test::ShownPicture;
using test::TestViewer;
using test::wait_until;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using namespace std::string_literals;

TEST(TevProtocol, MessagesHaveTheBytesOfTev) {
  EXPECT_EQ(tev_create("ab", 3, 258, {{"R"}, {"d.Z"}}),
            "\x1b\0\0\0\x04\x01"
            "ab\0"
            "\3\0\0\0\2\1\0\0\2\0\0\0"
            "R\0d.Z\0"s);
  const std::vector<float> values = {1, -2};
  EXPECT_EQ(tev_update("a", {5, 6, 7, 8}, {{"R"}, {"G"}}, values),
            "\x48\0\0\0\x06\0"
            "a\0"
            "\2\0\0\0R\0G\0"
            "\5\0\0\0\7\0\0\0\1\0\0\0\1\0\0\0"
            "\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0"
            "\2\0\0\0\0\0\0\0\2\0\0\0\0\0\0\0"
            "\0\0\x80\x3f\0\0\0\xc0"s);
}

bool same(const PixelRange& a, const PixelRange& b) {
  return a.x0 == b.x0 && a.x1 == b.x1 && a.y0 == b.y0 && a.y1 == b.y1;
}

TEST(TevProtocol, TilesAreJoinedInSquares) {
  // Two tiles of one square of 256 pixels, and one of the next.
  const std::vector<PixelRange> tiles = {{70, 128, 0, 64}, {128, 192, 64, 100}, {256, 300, 0, 64}};
  const std::vector<PixelRange> joined = joined_tiles(tiles, 3);
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_TRUE(same(joined[0], {70, 192, 0, 100}));
  EXPECT_TRUE(same(joined[1], tiles[2]));
  // A message of 22 channels would have 5.8 MB in the coarser grid.
  EXPECT_EQ(joined_tiles(tiles, 22).size(), 3u);
  EXPECT_TRUE(joined_tiles({}, 22).empty());
}

TEST(TevProtocol, LayersAreThoseOfLightAndFeaturesAndAov) {
  const auto names = [](const std::vector<std::string>& layers) {
    std::vector<std::string> all;
    for (const LiveChannel& channel : display_channels(layers)) all.push_back(channel.name);
    return all;
  };
  EXPECT_THAT(names({}), ElementsAre("R", "G", "B", "emitted.R", "emitted.G", "emitted.B", "direct.R",
                                     "direct.G", "direct.B", "caustic.R", "caustic.G", "caustic.B",
                                     "indirect.R", "indirect.G", "indirect.B", "albedo.R", "albedo.G",
                                     "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z"));
  EXPECT_EQ(names({"denoising", "direct", "denoising_depth"}), names({}));
  EXPECT_EQ(names({"photons"}).back(), "photons.Y");
  EXPECT_EQ(names({"all"}).size(), names({}).size() + 7);  // bias, photons, error
}

std::string address_text(const std::string& text) {
  return parse_address(text, 14158).text();
}

TEST(ServerAddress, HasAHostAndMayHaveAPort) {
  EXPECT_EQ(address_text("localhost"), "localhost:14158");
  EXPECT_EQ(address_text("viewer.example:80"), "viewer.example:80");
  EXPECT_EQ(address_text("127.0.0.1:65535"), "127.0.0.1:65535");
  EXPECT_EQ(address_text("[::1]"), "[::1]:14158");
  EXPECT_EQ(address_text("[2001:db8::7]:1"), "[2001:db8::7]:1");
}

TEST(ServerAddress, RefusesWhatCannotBeOne) {
  const auto trouble = [](const std::string& text) -> std::string {
    try {
      return "it is " + address_text(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_THAT(trouble(""), HasSubstr("the host is missing"));
  EXPECT_THAT(trouble(":14158"), HasSubstr("the host is missing"));
  for (const std::string port : {"", "0", "65536", "99999999999", "-1", "+1", "80a", " 80"})
    EXPECT_THAT(trouble("box:" + port),
                HasSubstr("`" + port + "` is not a port, a whole number from 1 to 65535"));
  EXPECT_THAT(trouble("::1"), HasSubstr("an IPv6 address stands in brackets"));
  EXPECT_THAT(trouble("::1:14158"), HasSubstr("an IPv6 address stands in brackets"));
  EXPECT_THAT(trouble("[::1"), HasSubstr("the closing bracket is missing"));
  EXPECT_THAT(trouble("[::1]14158"), HasSubstr("a colon and the port follow the bracket"));
  EXPECT_THAT(trouble("[::1]:"), HasSubstr("`` is not a port"));
  EXPECT_THAT(trouble("[box]:1"), HasSubstr("`box` is not an IPv6 address"));
  EXPECT_THAT(trouble("[]"), HasSubstr("`` is not an IPv6 address"));
  EXPECT_THAT(trouble("a box"), HasSubstr("`a box` is not the name of a host"));
  EXPECT_THAT(trouble("a/b:1"), HasSubstr("expected HOST or HOST:PORT"));
}

int open_files() {
  int count = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

// A display of a picture, a crop by default, with the viewer's manners that a test chooses.
class TevDisplayTest : public ::testing::Test {
 protected:
  void TearDown() override {
    stop();
    viewer_.reset();
    EXPECT_TRUE(wait_until([&] { return open_files() <= files_before_; }));
  }

  void make_picture(const PixelRange& range, int full_width, int full_height) {
    live_.emplace("box.pbrt", range, full_width, full_height);
  }
  void start() { display_.emplace(parse_address(viewer_->address(), 1), channels_, *live_, console_); }
  // As at the end of a render.
  void stop() { display_.reset(); }
  // Fills the picture with other numbers than before.
  void change() {
    const PixelRange& range = live_->picture.range();
    render::Film film(range.width(), range.height());
    for (int y = 0; y < range.height(); ++y)
      for (int x = 0; x < range.width(); ++x) {
        render::PixelResult& pixel = film.at(x, y);
        ++number_;
        pixel.direct = Rgb(float(number_), 1 / float(number_), -0.f);
        pixel.normal = Vector3(float(x), float(y), float(number_));
        pixel.depth = std::numeric_limits<float>::infinity();
      }
    live_->picture.show(film);
  }
  size_t picture_bytes() const { return live_->picture.range().pixels() * channels_.size() * sizeof(float); }

  // Whether the viewer shows the picture with the same bits, and nothing outside of it.
  bool shown() const {
    const ShownPicture picture = viewer_->picture();
    const PixelRange& range = live_->picture.range();
    if (picture.created == 0 || picture.channels.size() != channels_.size()) return false;
    std::vector<float> values(range.pixels() * channels_.size());
    live_->picture.read(range, channels_, values.data());
    const float* next = values.data();
    for (int y = range.y0; y < range.y1; ++y) {
      const size_t row = size_t(range.width()) * channels_.size();
      if (std::memcmp(picture.at(range.x0, y), next, row * sizeof(float)) != 0) return false;
      next += row;
    }
    const auto known = std::count_if(picture.values.begin(), picture.values.end(),
                                     [](float value) { return !std::isnan(value); });
    return size_t(known) == values.size();
  }
  // Waits for what the display says, and returns it.
  std::string next_message() {
    std::vector<LiveMessage> messages;
    EXPECT_TRUE(wait_until([&] { return !(messages = live_->take_messages()).empty(); }));
    std::string text;
    for (const LiveMessage& message : messages) text += (message.warning ? "warning: " : "") + message.text;
    return text;
  }
  std::string said() const { return err_.str(); }

  const int files_before_ = open_files();
  std::ostringstream out_, err_;
  const Console console_{out_, err_};
  const std::vector<LiveChannel> channels_ = display_channels({});
  std::optional<LiveRender> live_;
  std::optional<TestViewer> viewer_;
  std::optional<TevDisplay> display_;
  int number_ = 0;
};

TEST_F(TevDisplayTest, ACropIsShownAtItsPlaceBitByBit) {
  make_picture({70, 350, 33, 190}, 400, 200);
  change();
  viewer_.emplace().open();
  start();
  EXPECT_TRUE(wait_until([&] { return shown(); }));
  change();
  EXPECT_TRUE(wait_until([&] { return shown(); }));
  stop();
  EXPECT_TRUE(wait_until([&] { return viewer_->closed_by_others() == 1; }));
  const ShownPicture picture = viewer_->picture();
  EXPECT_EQ(picture.name, "box.pbrt");
  EXPECT_EQ(picture.width, 400);
  EXPECT_EQ(picture.height, 200);
  for (size_t c = 0; c < channels_.size(); ++c) EXPECT_EQ(picture.channels[c], channels_[c].name);
  EXPECT_EQ(picture.created, 1);
  EXPECT_LE(picture.most_side, 256);
  EXPECT_THAT(said(), IsEmpty());
}

// A render that is over before the viewer is connected.
TEST_F(TevDisplayTest, TheLastStateIsSent) {
  make_picture({0, 100, 0, 80}, 100, 80);
  viewer_.emplace().open();
  start();
  change();
  stop();
  EXPECT_TRUE(wait_until([&] { return viewer_->closed_by_others() == 1; }));
  EXPECT_TRUE(shown());
}

TEST_F(TevDisplayTest, BlocksOfARenderArrive) {
  make_picture({0, 200, 0, 100}, 200, 100);
  viewer_.emplace().open();
  start();
  std::vector<std::thread> threads;
  for (int t = 0; t < 2; ++t)
    threads.emplace_back([&, t] {
      render::FilmSums sums(200, 100);
      for (int y = 48 * t; y < 48 * t + 48; y += 4)
        for (int x = 0; x < 200; x += 4) {
          for (int i = 0; i < 16; ++i) {
            render::PixelResult sample;
            sample.indirect = Rgb(float(x), float(y), float(i));
            sums.at(x + i % 4, y + i / 4).add(sample);
          }
          live_->picture.add({x, x + 4, y, y + 4}, 4, sums);
        }
    });
  for (std::thread& thread : threads) thread.join();
  change();  // also where no block was
  EXPECT_TRUE(wait_until([&] { return shown(); }));
}

TEST_F(TevDisplayTest, AFewBytesAtATimeAreEnough) {
  make_picture({0, 48, 0, 32}, 48, 32);
  change();
  viewer_.emplace(Manners{.bytes = 97, .pause = std::chrono::milliseconds(1), .receive_buffer = 1}).open();
  start();
  EXPECT_TRUE(wait_until([&] { return shown(); }));
}

// A viewer that is busy for a while gets the newest state then, and none of those between.
TEST_F(TevDisplayTest, ABusyViewerSkipsToTheNewestState) {
  make_picture({0, 512, 0, 400}, 512, 400);
  ASSERT_GT(picture_bytes(), 16u << 20);  // more than the system keeps for a connection
  change();
  viewer_.emplace(Manners{.reads = false, .receive_buffer = 4096}).open();
  start();
  ASSERT_TRUE(wait_until([&] { return viewer_->connections() == 1; }));
  for (int i = 0; i < 20; ++i) change();
  EXPECT_FALSE(shown());
  viewer_->set_manners({});
  EXPECT_TRUE(wait_until([&] { return shown(); }));
  // What was on its way, the rest of the round that it belonged to, and a round of all changes since.
  EXPECT_LE(viewer_->received(), 3 * picture_bytes());
  stop();
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(TevDisplayTest, AViewerThatNeverReadsCostsAWarningAndLittleTime) {
  make_picture({0, 512, 0, 400}, 512, 400);
  change();
  viewer_.emplace(Manners{.reads = false}).open();
  start();
  ASSERT_TRUE(wait_until([&] { return viewer_->connections() == 1; }));
  change();
  const Stopwatch watch;
  stop();
  EXPECT_LT(watch.seconds(), 20);  // one second, and what a busy machine takes
  EXPECT_EQ(said(), "kaustik: warning: the viewer at " + viewer_->address() +
                        " did not take all of the finished picture: it was too slow\n");
}

TEST_F(TevDisplayTest, AViewerThatClosesInAMessageGetsTheWholePictureLater) {
  make_picture({0, 300, 0, 200}, 300, 200);
  change();
  viewer_.emplace(Manners{.close_after = 30'000}).open();
  start();
  EXPECT_THAT(next_message(), HasSubstr("warning: lost the viewer at " + viewer_->address() + ": "));
  viewer_->set_manners({});
  EXPECT_TRUE(wait_until([&] { return shown(); }));
  EXPECT_EQ(next_message(), "the viewer at " + viewer_->address() + " is there");
  EXPECT_GE(viewer_->picture().created, 2);
  stop();
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(TevDisplayTest, AViewerMayComeLater) {
  make_picture({0, 100, 0, 80}, 100, 80);
  change();
  viewer_.emplace();
  start();
  EXPECT_EQ(next_message(), "warning: no viewer at " + viewer_->address() +
                                ": Connection refused; it gets the picture when it is there");
  viewer_->open();
  EXPECT_TRUE(wait_until([&] { return shown(); }));
  EXPECT_EQ(next_message(), "the viewer at " + viewer_->address() + " is there");
}

TEST_F(TevDisplayTest, AViewerMayDieAndComeBack) {
  make_picture({0, 100, 0, 80}, 100, 80);
  change();
  viewer_.emplace().open();
  start();
  ASSERT_TRUE(wait_until([&] { return shown(); }));
  for (int times = 0; times < 2; ++times) {
    viewer_->close();
    EXPECT_THAT(next_message(), HasSubstr("warning: lost the viewer at " + viewer_->address()));
    change();
    viewer_->open();
    EXPECT_TRUE(wait_until([&] { return shown(); }));
    EXPECT_EQ(next_message(), "the viewer at " + viewer_->address() + " is there");
  }
  EXPECT_EQ(viewer_->picture().created, 3);
}

TEST_F(TevDisplayTest, AViewerThatIsNeverThereIsOneWarning) {
  make_picture({0, 100, 0, 80}, 100, 80);
  viewer_.emplace();
  start();
  EXPECT_THAT(next_message(), HasSubstr("no viewer"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // further attempts
  stop();
  EXPECT_THAT(said(), IsEmpty());
}

}  // namespace
}  // namespace kaustik::app
