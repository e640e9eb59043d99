#pragma once
// The messages between the ranks of a render. Rank 0 leads: it hands out passes and adds their sums.

#include <chrono>
#include <cstring>
#include <string>

namespace kaustik::app {

enum class RankCall : int {
  // From rank 0.
  kBegin,   // a BeginText: what to render
  kRender,  // a number: render this pass
  kSend,    // the text of a PassSet: send their sums
  kEnd,     // render no more
  kClose,   // "orderly", or empty: leave, without waiting for ranks that are lost
  // From all.
  kAlive,  // a number: the share of the present pass that is done, in thousandths
  // To rank 0.
  kWants,     // asks for a pass
  kRendered,  // a number: this pass is finished, and its sums are kept
  kSums,      // manifest_text(): sums, whose pixels follow
  kPixels,    // the next bytes of their pixels
  kFailed,    // a text: why this rank takes no part any more
  kBye        // follows kEnd: nothing comes any more
};

// A message that waits to be sent.
struct RankOrder {
  int rank = 0;  // the receiver
  RankCall call{};
  std::string body{};
};

inline std::string number_body(uint64_t number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}
inline uint64_t number_of(const std::string& body) {
  uint64_t number = 0;
  if (body.size() == sizeof number) std::memcpy(&number, body.data(), sizeof number);
  return number;
}

// The body of kBegin.
struct BeginText {
  bool in_order = false;       // whether rank 0 adds passes by their index
  std::string command_line{};  // of rank 0
  std::string manifest{};      // of a partial result without passes: it holds the settings and the radii

  std::string body() const {
    return (in_order ? "o" : "-") + number_body(command_line.size()) + command_line + manifest;
  }
  // body: made by body().
  static BeginText from(const std::string& body) {
    constexpr size_t kHead = 1 + sizeof(uint64_t);
    const size_t line = size_t(number_of(body.substr(1, sizeof(uint64_t))));
    return {body[0] == 'o', body.substr(kHead, line), body.substr(kHead + line)};
  }
};

// The largest body of kPixels: other messages pass between them.
inline constexpr size_t kPixelBytes = size_t{8} << 20;

using RankClock = std::chrono::steady_clock;
inline double seconds_since(RankClock::time_point start) {
  return std::chrono::duration<double>(RankClock::now() - start).count();
}

// How long a thread that waits for another rank sleeps before it looks for a signal.
inline constexpr auto kRankWake = std::chrono::milliseconds(100);
// How often a rank says that it is alive, in seconds.
inline constexpr double kAliveEvery = 0.5;

}  // namespace kaustik::app
