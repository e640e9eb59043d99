#pragma once
// The messages between the ranks of a render. Rank 0 leads: it hands out passes and adds their sums.

#include <chrono>
#include <cstring>
#include <optional>
#include <span>
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

// A message of rank 0 that waits to be sent.
struct RankOrder {
  int rank = 0;
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

// The body of kBegin: whether sums are fetched in order, and manifest_text() of no pass with the render's
// radii.
struct BeginText {
  bool in_order = false;
  std::string manifest{};

  std::string body() const { return (in_order ? "o" : "-") + manifest; }
  static BeginText from(const std::string& body) {
    return {!body.empty() && body[0] == 'o', body.substr(!body.empty())};
  }
};

// The largest body of kPixels: other messages pass between them.
inline constexpr size_t kPixelBytes = size_t{8} << 20;

using RankClock = std::chrono::steady_clock;
inline double seconds_since(RankClock::time_point start) {
  return std::chrono::duration<double>(RankClock::now() - start).count();
}

// How often what waits for another rank looks for a signal.
inline constexpr auto kRankWake = std::chrono::milliseconds(100);
// Passes whose sums a rank keeps until those before them have been added, where they are added in order.
inline constexpr size_t kMostHeld = 2;
// How often a rank says that it is alive, in seconds.
inline constexpr double kAliveEvery = 0.5;

}  // namespace kaustik::app
