#pragma once
// Interface to MPI, which carries messages between the processes of a render. It is an interface because only
// programs that an MPI launcher has started load the library.

#include <cstddef>
#include <memory>
#include <string>

namespace kaustik::app {

struct RankMessage {
  int rank = 0;  // the sender
  int kind = 0;  // see RankCall
  std::string body{};
};

// One rank's messages to and from all others. Messages of one sender to one receiver arrive in their order.
// All calls come from the thread that opened the link. None waits.
class RankLink {
 public:
  virtual ~RankLink() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  virtual void send(int to, int kind, std::string body) = 0;
  // How many messages to a rank are still under way.
  virtual size_t unsent(int to) = 0;
  // Takes the next message; false if none has arrived.
  virtual bool receive(RankMessage* message) = 0;
  // Ends all communication. orderly: every rank does so, and waits for the others; otherwise nothing is
  // waited for.
  virtual void close(bool orderly) = 0;
};

// Joins the ranks that the launcher has started. Throws std::runtime_error if the library cannot be loaded or
// refuses.
std::unique_ptr<RankLink> open_rank_link();

}  // namespace kaustik::app
