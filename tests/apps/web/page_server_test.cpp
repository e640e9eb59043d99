// The live page from the outside: what it serves, what it refuses, and what its readers ask of the render.

#include "apps/web/page_server.h"

#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include "apps/console/exit_error.h"
#include "render/picture/exr_file.h"
#include "render/picture/image_io.h"
#include "tests/apps/support/http_client.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

using test::http;
using test::HttpConnection;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class PageServerTest : public test::ProgramTest {
 protected:
  PageServerTest() {
    render::Film film(100, 70);
    for (int y = 0; y < 70; ++y)
      for (int x = 0; x < 100; ++x) {
        film.at(x, y).direct = Rgb(float(x), float(y), 0.5f);
        film.at(x, y).depth = float(x + y);
      }
    live_->picture.show(film);
  }
  int port() const {
    const std::string url = page_->url();
    return std::stoi(url.substr(url.rfind(':') + 1));
  }
  std::shared_ptr<LiveRender> live_ =
      std::make_shared<LiveRender>("a <room>.pbrt", render::PixelRange{0, 100, 0, 70}, 100, 70);
  std::ostringstream out_, err_;
  const Console console_{out_, err_, false, false};
  std::unique_ptr<PageServer> page_ =
      std::make_unique<PageServer>(PageOptions{}, live_, PageExtension{}, console_);
};

TEST_F(PageServerTest, ServesOnePageWithoutTheNetwork) {
  EXPECT_EQ(out_.str(), page_->url() + "\n");
  const test::HttpAnswer page = http(port(), "GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_THAT(page.body, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page.head, HasSubstr("X-Content-Type-Options: nosniff"));
}

// As clients do on a busy machine.
TEST_F(PageServerTest, WaitsForTheFirstRequestOfAConnection) {
  const HttpConnection connection(port());
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  connection.send("GET /info HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) + "\r\n\r\n");
  EXPECT_THAT(connection.receive(), ::testing::StartsWith("HTTP/1.1 200"));
}

TEST_F(PageServerTest, InfoNamesTheLayers) {
  const Json info = Json::parse(http(port(), "GET", "/info").body);
  EXPECT_EQ(info["title"], "a <room>.pbrt");
  EXPECT_EQ(info["full_width"], 100);
  EXPECT_EQ(info["layers"][0]["label"], "all light");
  EXPECT_FALSE(info["lab"]);
}

// Numbers as the page reads them: four of the head, then tiles.
TEST_F(PageServerTest, PixelsAreTilesThatChanged) {
  const std::string bytes = http(port(), "GET", "/pixels?layer=depth&since=0").body;
  const auto word = [&](size_t i) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + 4 * i, 4);
    return value;
  };
  ASSERT_EQ(word(3), 4u);
  size_t at = 4;
  for (int tile = 0; tile < 4; ++tile) {
    const uint32_t x = word(at), y = word(at + 1), width = word(at + 2), height = word(at + 3);
    EXPECT_EQ(width, x == 0 ? 64u : 36u);
    EXPECT_EQ(height, y == 0 ? 64u : 6u);
    float last = 0;
    std::memcpy(&last, bytes.data() + 4 * (at + 3 + width * height), 4);
    EXPECT_EQ(last, float(x + width - 1 + y + height - 1));
    at += 4 + width * height;
  }
  EXPECT_EQ(bytes.size(), 4 * at);
  const std::string version = std::to_string(word(0));
  EXPECT_EQ(http(port(), "GET", "/pixels?layer=&since=" + version).body.size(), 16u) << "nothing has changed";
  EXPECT_EQ(http(port(), "GET", "/pixels?layer=colour&since=0").status, 404);
}

TEST_F(PageServerTest, ReadersPauseAndStopTheRender) {
  EXPECT_EQ(http(port(), "POST", "/pause").status, 204);
  EXPECT_EQ(live_->status().state, LiveState::kPaused);
  EXPECT_EQ(http(port(), "POST", "/resume").status, 204);
  EXPECT_EQ(live_->status().state, LiveState::kRunning);
  EXPECT_TRUE(live_->go_on([] { return false; }));
  EXPECT_EQ(http(port(), "GET", "/stop").status, 404) << "a link must not stop a render";
  EXPECT_EQ(http(port(), "POST", "/stop").status, 204);
  EXPECT_FALSE(live_->go_on([] { return false; }));
}

TEST_F(PageServerTest, RefusesOtherHostsOriginsAndPaths) {
  EXPECT_EQ(http(port(), "GET", "/", "Host: evil.example\r\n").status, 403);
  const std::string host = "Host: localhost:" + std::to_string(port()) + "\r\n";
  EXPECT_EQ(http(port(), "GET", "/info", host).status, 200);
  EXPECT_EQ(http(port(), "POST", "/stop", host + "Origin: http://evil.example\r\n").status, 403);
  EXPECT_FALSE(live_->status().stopped);
  for (const char* path : {"/../../etc/passwd", "/etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd"})
    EXPECT_THAT(http(port(), "GET", path).status, ::testing::AnyOf(400, 404)) << path;
  EXPECT_THAT(http(port(), "POST", "/pause", "", std::string(1 << 20, 'x')).status, ::testing::AnyOf(0, 413));
  EXPECT_EQ(http(port(), "GET", "/info").status, 200) << "and goes on";
}

TEST_F(PageServerTest, SavesThePicture) {
  const test::HttpAnswer exr = http(port(), "GET", "/save?format=exr");
  ASSERT_EQ(exr.status, 200);
  EXPECT_THAT(exr.head, HasSubstr("filename=\"a__room_.exr\""));
  const render::ExrChannels file = render::read_exr_file(write("saved.exr", exr.body), 7000);
  ASSERT_NE(file.find("depth.Z"), nullptr);
  EXPECT_EQ((*file.find("G"))[69 * 100], 69);
  EXPECT_THAT(http(port(), "GET", "/save?format=png&exposure=-5").body, ::testing::StartsWith("\x89PNG"));
  EXPECT_EQ(http(port(), "GET", "/save?format=png&exposure=x").status, 400);
  EXPECT_EQ(http(port(), "GET", "/save?format=bmp").status, 400);
}

TEST_F(PageServerTest, TenReadersHearOfTheEnd) {
  std::vector<std::thread> readers;
  std::atomic<int> began{0}, ends{0};
  for (int i = 0; i < 10; ++i)
    readers.emplace_back([&, at = port()] {
      const HttpConnection connection(at);
      connection.send("GET /events HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(at) + "\r\n\r\n");
      std::string all = connection.receive();
      ++began;
      for (std::string some = connection.receive(); !some.empty(); some = connection.receive()) all += some;
      ends += all.find("event: status") != std::string::npos && all.find("\"finished\"") != std::string::npos;
    });
  for (int i = 0; began < 10 && i < 10'000; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  live_->finish();
  page_.reset();
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(ends, 10);
}

// Pixel (x, y) of the reference is (x, y, 0).
TEST_F(PageServerTest, GivesTheReference) {
  const auto picture = [&](const std::string& name, int width, int height) {
    render::Film film(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) film.at(x, y).direct = Rgb(float(x), float(y), 0);
    render::write_film(path(name), film, {});
    return path(name);
  };
  const auto crop = std::make_shared<LiveRender>("crop", render::PixelRange{10, 30, 5, 9}, 100, 70);
  PageOptions options;
  options.reference = picture("full.exr", 100, 70);
  const auto pixel = [&](const PageServer& page, size_t i) {
    const std::string url = page.url();
    const int at = std::stoi(url.substr(url.rfind(':') + 1));
    EXPECT_EQ(Json::parse(http(at, "GET", "/info").body)["reference"].get<std::string>().substr(0, 4),
              std::filesystem::path(options.reference).filename().string().substr(0, 4));
    const std::string bytes = http(at, "GET", "/reference").body;
    EXPECT_EQ(bytes.size(), 20u * 4 * 3 * 4);
    float values[3] = {};
    std::memcpy(values, bytes.data() + 12 * i, 12);
    return std::pair(values[0], values[1]);
  };
  EXPECT_EQ(pixel(PageServer(options, crop, {}, console_), 21), std::pair(11.0f, 6.0f))
      << "of the full picture";
  options.reference = picture("crop.exr", 20, 4);
  EXPECT_EQ(pixel(PageServer(options, crop, {}, console_), 21), std::pair(1.0f, 1.0f)) << "of the crop";
  EXPECT_EQ(http(port(), "GET", "/reference").status, 404) << "there is none";
  for (const std::string& wrong :
       {picture("other.exr", 30, 4), path("missing.exr"), write("text.exr", "text")}) {
    options.reference = wrong;
    try {
      PageServer page(options, crop, {}, console_);
      ADD_FAILURE() << wrong;
    } catch (const ExitError& error) {
      EXPECT_EQ(error.code(), kBadCommandLine);
      EXPECT_THAT(error.what(), HasSubstr(wrong));
    }
  }
}

// There are more of them than streams at a time.
TEST_F(PageServerTest, ReadersThatLeaveMakeRoom) {
  const std::string ask = "GET /events HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) + "\r\n\r\n";
  for (int i = 0; i < 40; ++i) {
    const HttpConnection connection(port());
    connection.send(ask);
    if (i % 2 == 0) connection.receive();
  }
  EXPECT_EQ(http(port(), "GET", "/info").status, 200);
  // A stream notices at its next event, a second later at most, that its reader has left.
  std::string head;
  for (int attempt = 0; attempt < 50 && !head.starts_with("HTTP/1.1 200"); ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const HttpConnection connection(port());
    connection.send(ask);
    head = connection.receive();
  }
  EXPECT_THAT(head, ::testing::StartsWith("HTTP/1.1 200"));
}

TEST_F(PageServerTest, NamesOfFilesNeedNotBeText) {
  const auto odd = std::make_shared<LiveRender>("caf\xe9.pbrt", render::PixelRange{0, 4, 0, 4}, 4, 4);
  page_->show(odd);
  EXPECT_EQ(Json::parse(http(port(), "GET", "/info").body)["title"], "caf\xef\xbf\xbd.pbrt");
}

TEST_F(PageServerTest, ATakenPortIsAnError) {
  PageOptions same;
  same.port = port();
  try {
    PageServer second(same, live_, {}, console_);
    FAIL() << "two servers share a port";
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kFailed);
    EXPECT_THAT(error.what(), HasSubstr("port " + std::to_string(port())));
  }
}

}  // namespace
}  // namespace kaustik::app
