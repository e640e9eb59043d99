#pragma once
// A viewer that speaks tev's protocol, with manners that a test chooses. It takes messages apart byte by byte
// and fails the test for those that tev would not understand.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace kaustik::test {

// Asks until the answer is yes, or for a minute.
inline bool wait_until(const std::function<bool()>& question) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!question()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

// A picture as the viewer shows it. Where nothing has arrived, it is not a number.
struct ShownPicture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;  // row by row, the channels of a pixel together
  int created = 0, updates = 0;
  int least_side = std::numeric_limits<int>::max(), most_side = 0;  // of updates

  const float* at(int x, int y) const {
    return values.data() + (size_t(y) * size_t(width) + size_t(x)) * channels.size();
  }
};

// Reads the parts of a message.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    Number value{};
    read(&value, sizeof value);
    return value;
  }
  std::string text() {
    std::string value;
    while (!bytes_.empty() && bytes_.front() != '\0') value += char(number<uint8_t>());
    EXPECT_EQ(number<uint8_t>(), 0);
    return value;
  }
  void read(void* to, size_t size) {
    ASSERT_LE(size, bytes_.size()) << "the message ends early";
    std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

inline void create_picture(MessageReader message, ShownPicture* picture) {
  EXPECT_EQ(message.number<uint8_t>(), 1);  // to the front
  picture->name = message.text();
  picture->width = message.number<int32_t>(), picture->height = message.number<int32_t>();
  picture->channels.resize(size_t(message.number<int32_t>()));
  for (std::string& channel : picture->channels) channel = message.text();
  EXPECT_EQ(message.left(), 0u);
  picture->values.assign(size_t(picture->width) * size_t(picture->height) * picture->channels.size(),
                         std::numeric_limits<float>::quiet_NaN());
  ++picture->created;
}

inline void update_picture(MessageReader message, ShownPicture* picture) {
  ASSERT_GT(picture->created, 0) << "a picture was updated that was never created";
  EXPECT_EQ(message.number<uint8_t>(), 0);  // not to the front
  EXPECT_EQ(message.text(), picture->name);
  const auto count = size_t(message.number<int32_t>());
  ASSERT_EQ(count, picture->channels.size());
  for (const std::string& channel : picture->channels) EXPECT_EQ(message.text(), channel);
  const auto x0 = message.number<int32_t>(), y0 = message.number<int32_t>();
  const auto width = message.number<int32_t>(), height = message.number<int32_t>();
  ASSERT_TRUE(x0 >= 0 && y0 >= 0 && width > 0 && height > 0);
  ASSERT_TRUE(x0 + width <= picture->width && y0 + height <= picture->height);
  for (size_t c = 0; c < count; ++c) ASSERT_EQ(message.number<int64_t>(), int64_t(c));
  for (size_t c = 0; c < count; ++c) ASSERT_EQ(message.number<int64_t>(), int64_t(count));
  ASSERT_EQ(message.left(), size_t(width) * size_t(height) * count * sizeof(float));
  for (int y = y0; y < y0 + height; ++y)
    message.read(const_cast<float*>(picture->at(x0, y)), size_t(width) * count * sizeof(float));
  ++picture->updates;
  picture->least_side = std::min({picture->least_side, width, height});
  picture->most_side = std::max({picture->most_side, width, height});
}

struct Manners {
  bool reads = true;
  size_t bytes = 1 << 16;                                   // read at a time
  std::chrono::milliseconds pause{};                        // after each time
  size_t close_after = std::numeric_limits<size_t>::max();  // bytes of a connection
  int receive_buffer = 0;                                   // bytes; 0: the system's
};

// Listens on 127.0.0.1. A port that the constructor has taken refuses connections until open().
class TestViewer {
 public:
  explicit TestViewer(Manners manners = {}) : manners_(manners) { bind_to(0); }
  ~TestViewer() { close(); }
  TestViewer(const TestViewer&) = delete;
  TestViewer& operator=(const TestViewer&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  void open() {
    if (listener_ < 0) bind_to(port_);
    ASSERT_EQ(listen(listener_, 4), 0);
    ended_ = false;
    thread_ = std::thread([this] { serve(); });
  }
  // Dies, with all connections.
  void close() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    if (listener_ >= 0) ::close(listener_);
    listener_ = -1;
  }
  void set_manners(Manners manners) {
    const std::lock_guard lock(mutex_);
    manners_ = manners;
  }

  // How many connections have been opened, and how many of them the other side has closed.
  int connections() const { return connections_; }
  int closed_by_others() const { return closed_by_others_; }
  size_t received() const { return received_; }
  ShownPicture picture() const {
    const std::lock_guard lock(mutex_);
    return picture_;
  }

 private:
  void bind_to(uint16_t port) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (manners_.receive_buffer > 0)
      setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &manners_.receive_buffer, sizeof(int));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    ASSERT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }

  Manners manners() const {
    const std::lock_guard lock(mutex_);
    return manners_;
  }

  // Whether there is something to read or accept, or the viewer ends.
  bool wait_readable(int socket) const {
    pollfd entry{socket, POLLIN, 0};
    while (!ended_)
      if (poll(&entry, 1, 5) > 0) return true;
    return false;
  }

  void serve() {
    while (wait_readable(listener_)) {
      const int connection = accept(listener_, nullptr, nullptr);
      if (connection < 0) continue;
      ++connections_;
      closed_by_others_ += read_all(connection);
      ::close(connection);
    }
  }

  // Returns whether the other side has closed the connection.
  bool read_all(int connection) {
    std::string pending;
    size_t count = 0;
    while (wait_readable(connection)) {
      const Manners now = manners();
      if (!now.reads) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      std::vector<char> buffer(std::min(now.bytes, now.close_after - count));
      const ssize_t size = recv(connection, buffer.data(), buffer.size(), 0);
      if (size <= 0) {
        EXPECT_TRUE(pending.empty()) << "the last message was cut off";
        return true;
      }
      count += size_t(size), received_ += size_t(size);
      pending.append(buffer.data(), size_t(size));
      take_messages(&pending);
      if (count >= now.close_after) return false;
      std::this_thread::sleep_for(now.pause);
    }
    return false;
  }

  void take_messages(std::string* pending) {
    const std::lock_guard lock(mutex_);
    size_t done = 0;
    while (pending->size() - done >= 5) {
      uint32_t size = 0;
      std::memcpy(&size, pending->data() + done, sizeof size);
      ASSERT_TRUE(size > 5 && size < (5 << 20)) << size;
      if (pending->size() - done < size) break;
      const uint8_t kind = uint8_t((*pending)[done + 4]);
      const MessageReader message(std::string_view(*pending).substr(done + 5, size - 5));
      ASSERT_TRUE(kind == 4 || kind == 6) << int(kind);
      if (kind == 4)
        create_picture(message, &picture_);
      else
        update_picture(message, &picture_);
      done += size;
    }
    pending->erase(0, done);
  }

  int listener_ = -1;
  uint16_t port_ = 0;
  std::thread thread_;
  std::atomic<bool> ended_ = false;
  std::atomic<int> connections_ = 0, closed_by_others_ = 0;
  std::atomic<size_t> received_ = 0;
  mutable std::mutex mutex_;  // guards what follows
  Manners manners_;
  ShownPicture picture_;
};

}  // namespace kaustik::test
