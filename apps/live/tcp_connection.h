#pragma once
// A TCP connection to a server that may be slow, die, or not be there: nothing here blocks for longer than
// the caller wants to wait, and no signal is raised.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace kaustik::app {

struct ServerAddress {
  std::string host;  // a name, or an IPv4 or IPv6 address, without brackets
  uint16_t port = 0;

  // As parse_address() reads it.
  std::string text() const;
};

// From "HOST" or "HOST:PORT", where an IPv6 address stands in brackets. Throws std::invalid_argument, whose
// message says what is wrong, for anything else. Does not ask whether the host exists.
ServerAddress parse_address(std::string_view text, uint16_t default_port);

// Asked several times a second by functions that wait; they give up when it returns false.
using KeepWaiting = std::function<bool()>;

// Not thread-safe.
class TcpConnection {
 public:
  TcpConnection() = default;
  ~TcpConnection() { close(); }
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  bool is_open() const { return socket_ >= 0; }
  // Why it is closed, if it could not be opened or was lost.
  const std::string& trouble() const { return trouble_; }

  // Tries the addresses of the host one after the other, each for two seconds at most. False if there is no
  // connection now.
  bool open(const ServerAddress& address, const KeepWaiting& keep_waiting);
  // Throws away what the server has sent, and returns whether the connection is still there. If not, it is
  // closed.
  bool check();
  // Returns whether the system has taken all bytes. If not, the connection is lost and closed, or the caller
  // gave up and it is still open, with a part of the bytes sent.
  bool send(std::string_view bytes, const KeepWaiting& keep_waiting);
  // The system delivers what it has taken.
  void close();

 private:
  // Closes the connection because of an error number of the system; 0: the server has closed it.
  void lose(int error);

  int socket_ = -1;
  std::string trouble_;
};

}  // namespace kaustik::app
