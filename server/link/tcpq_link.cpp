#include "server/link/tcpq_link.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "forward/base/types.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "server/link/silenced.hpp"
#include "server/link/tcp_address.hpp"

namespace genio {

namespace {

constexpr time_t longest_stall_s = 5;
constexpr int receive_buffer = 32 << 10;

constexpr int longest_pause_ms = 100;  // between two tries to connect

/// True where the socket becomes ready for `events` in time.
bool ready(int fd, short events, int longest_ms) {
  pollfd polled{fd, events, 0};
  return poll(&polled, 1, longest_ms) == 1 && (polled.revents & events);
}

/// True where a hub greets back: LCM itself would wait for that without end.
bool greets(int fd, int longest_ms) {
  const std::vector<char> greeting = tcpq::greeting(tcpq::client_mark);
  const auto sent = send(fd, greeting.data(), greeting.size(), MSG_NOSIGNAL);
  if (sent != ssize_t(greeting.size())) return false;
  std::vector<char> answer(tcpq::greeting_bytes);
  size_t got = 0;
  while (got < answer.size() && ready(fd, POLLIN, longest_ms)) {
    const auto n = recv(fd, answer.data() + got, answer.size() - got, 0);
    if (n <= 0) return false;
    got += size_t(n);
  }
  return got == answer.size() && tcpq::word_at(answer, 0) == tcpq::server_mark;
}

/// True where a hub listens there.
bool answers(const std::string& host, uint16_t port) {
  constexpr int longest_ms = 1000;
  sockaddr_in address{};
  address.sin_family = AF_INET;  // as LCM
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) return false;
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  bool good = ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (!good && errno == EINPROGRESS) {
    int error = 0;
    socklen_t size = sizeof error;
    good = ready(fd, POLLOUT, longest_ms) &&
           getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
  }
  good = good && greets(fd, longest_ms);
  close(fd);
  return good;
}

/// True where the other side is gone, of which LCM prints a line.
bool is_closed(int fd) {
  char byte = 0;
  return recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

[[noreturn]] void refuse_hub(const std::string& url) {
  throw InputError(
      fmt::format("--lcm {}: cannot be used; expected for example tcpq://127.0.0.1:7700", url));
}

}  // namespace

struct TcpqLink::Subscription {
  std::string channel;
  Handler handler;

  void subscribe(lcm_t* lcm) {
    lcm_subscribe(
        lcm, channel.c_str(),
        [](const lcm_recv_buf_t* buffer, const char* name, void* user) {
          // No exception may pass through LCM's C frames.
          try {
            static_cast<Subscription*>(user)->handler(name, buffer->data, buffer->data_size);
          } catch (...) {
          }
        },
        this);
  }
};

TcpqLink::TcpqLink(const std::string& url) : url_(url) {
  if (!tcp_address(url)) refuse_hub(url);
  connect();
}

uint16_t TcpqLink::local_port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (!connected() ||
      getsockname(lcm_get_fileno(lcm_), reinterpret_cast<sockaddr*>(&address), &size) != 0)
    return 0;
  return ntohs(address.sin_port);
}

bool TcpqLink::connected() const { return lcm_ && lcm_get_fileno(lcm_) >= 0; }

void TcpqLink::create(const std::string& url) {
  {
    const Silenced lcm;
    lcm_ = lcm_create(url.c_str());
  }
  if (!lcm_) refuse_hub(url_);
  for (Subscription& s : subscriptions_) s.subscribe(lcm_);
  tune();
}

bool TcpqLink::connect() {
  if (connected()) return true;
  // LCM takes every name that it cannot read for this host, so it gets the address.
  const TcpAddress address = tcp_address(url_).value();
  const auto host = numeric_host(address.host);
  // LCM may wait for minutes where nobody answers.
  if (!host || !answers(*host, address.port)) return false;
  if (!lcm_) {
    create(fmt::format("tcpq://{}:{}", *host, address.port));
  } else {
    // LCM reconnects, and subscribes again, when something is published.
    const Silenced lcm;
    const uint8_t nothing = 0;
    lcm_publish(lcm_, "GENIO_RECONNECT", &nothing, 1);
  }
  if (connected()) tune();
  return connected();
}

TcpqLink::~TcpqLink() {
  if (lcm_) lcm_destroy(lcm_);
}

void TcpqLink::tune() {
  // LCM leaves Nagle's algorithm and delayed acknowledgements on: 88 ms a round trip.
  const int fd = lcm_get_fileno(lcm_);
  if (fd < 0) return;
  const int one = 1;
  if (fd != tuned_fd_) {
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    // What waits in it can no longer give way to what others send.
    setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    // LCM would wait without end for a hub that stops in the middle of a message.
    const timeval longest{longest_stall_s, 0};
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
  }
  setsockopt(fd, IPPROTO_TCP, TCP_QUICKACK, &one, sizeof one);
  tuned_fd_ = fd;
}

void TcpqLink::subscribe(const std::string& channel, Handler handler) {
  subscriptions_.push_back({channel, std::move(handler)});
  if (lcm_) subscriptions_.back().subscribe(lcm_);
}

bool TcpqLink::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  if (!connect()) return false;
  std::optional<Silenced> lcm;
  if (is_closed(lcm_get_fileno(lcm_))) lcm.emplace();
  const bool sent = lcm_publish(lcm_, channel.c_str(), bytes.data(), unsigned(bytes.size())) == 0;
  tune();
  return sent;
}

bool TcpqLink::wait(int timeout_ms, std::span<const int> others) {
  std::vector<pollfd> polled;
  for (int fd : others) polled.push_back({fd, POLLIN, 0});
  // LCM's own waiting functions would abort the process or block for ever without a connection.
  if (!connect()) {
    poll(polled.data(), polled.size(), std::min(timeout_ms, longest_pause_ms));
    return false;
  }
  const int fd = lcm_get_fileno(lcm_);
  polled.push_back({fd, POLLIN, 0});
  if (poll(polled.data(), polled.size(), timeout_ms) <= 0) return true;
  if (!(polled.back().revents & (POLLIN | POLLHUP | POLLERR))) return true;
  std::optional<Silenced> lcm;
  if (is_closed(fd)) lcm.emplace();
  const bool good = lcm_handle(lcm_) == 0;
  tune();
  return good;
}

}  // namespace genio
