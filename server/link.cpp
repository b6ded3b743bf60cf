#include "server/link.hpp"

#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <regex>
#include <thread>

#include "forward/base/types.hpp"
#include "server/silenced.hpp"

namespace genio {

namespace {

struct TcpAddress {
  std::string host, port;
};

/// Of "tcpq://HOST:PORT", both of which may be left out; nothing for what is no such URL.
std::optional<TcpAddress> tcp_address(const std::string& url) {
  static const std::regex pattern(R"(tcpq://([^:/?\s]*)(?::(\d{1,5}))?/?(?:\?.*)?)");
  std::smatch m;
  if (!std::regex_match(url, m, pattern)) return std::nullopt;
  const int port = m[2].matched ? std::stoi(m[2]) : 7700;
  if (port < 1 || port > 65535) return std::nullopt;
  return TcpAddress{m[1].length() > 0 ? m[1].str() : "127.0.0.1", std::to_string(port)};
}

/// True where the socket becomes ready for `events` in time.
bool ready(int fd, short events, int longest_ms) {
  pollfd polled{fd, events, 0};
  return poll(&polled, 1, longest_ms) == 1 && (polled.revents & events);
}

/// True where a hub greets back, as in lcm_tcpq.c: LCM itself would wait for that without end.
bool greets(int fd, int longest_ms) {
  constexpr unsigned char greeting[] = {0x28, 0x76, 0x17, 0xfb, 0, 0, 1, 0};
  constexpr unsigned char expected[] = {0x28, 0x76, 0x17, 0xfa};
  if (send(fd, greeting, sizeof greeting, MSG_NOSIGNAL) != sizeof greeting) return false;
  unsigned char answer[8];
  size_t got = 0;
  while (got < sizeof answer && ready(fd, POLLIN, longest_ms)) {
    const auto n = recv(fd, answer + got, sizeof answer - got, 0);
    if (n <= 0) return false;
    got += size_t(n);
  }
  return got == sizeof answer && std::equal(std::begin(expected), std::end(expected), answer);
}

bool answers(const addrinfo& address) {
  constexpr int longest_ms = 1000;
  const int fd = socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  bool good = ::connect(fd, address.ai_addr, address.ai_addrlen) == 0;
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

/// True where a hub listens there.
bool answers(const TcpAddress& address) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_INET;  // as LCM
  wanted.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &found) != 0) return false;
  bool good = false;
  for (const addrinfo* a = found; a && !good; a = a->ai_next) good = answers(*a);
  freeaddrinfo(found);
  return good;
}

/// True where the other side is gone, of which LCM prints a line.
bool is_closed(int fd) {
  char byte = 0;
  return recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

[[noreturn]] void refuse_url(const std::string& url) {
  throw InputError(fmt::format(
      "--lcm {}: cannot be used; expected for example {} or udpm://239.255.76.67:7667?ttl=0 "
      "(which needs a multicast route)",
      url, default_url));
}

}  // namespace

struct Link::Subscription {
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

std::string choose_url(const std::string& option) {
  if (!option.empty()) return option;
  const char* url = std::getenv("LCM_DEFAULT_URL");
  return url && *url ? url : default_url;
}

uint16_t local_tcpq_port(const std::string& url) {
  static const std::regex pattern(R"(tcpq://(127\.0\.0\.1|localhost)?(?::(\d{1,5}))?/?)");
  std::smatch m;
  if (!std::regex_match(url, m, pattern)) return 0;
  const int port = m[2].matched ? std::stoi(m[2]) : 7700;
  return port > 0 && port < 65536 ? uint16_t(port) : 0;
}

Link::Link(const std::string& url) : url_(url), tcp_(url.starts_with("tcpq")) {
  if (tcp_ && !tcp_address(url)) refuse_url(url);
  if (tcp_) connect();
  else create();
}

bool Link::connected() const { return lcm_ && (!tcp_ || lcm_get_fileno(lcm_) >= 0); }

void Link::create() {
  {
    const Silenced lcm;
    lcm_ = lcm_create(url_.c_str());
  }
  if (!lcm_) refuse_url(url_);
  for (Subscription& s : subscriptions_) s.subscribe(lcm_);
  tune();
}

bool Link::connect() {
  if (connected()) return true;
  // LCM may wait for minutes where nobody answers.
  if (!answers(tcp_address(url_).value())) return false;
  if (!lcm_) {
    create();
  } else {
    // LCM reconnects, and subscribes again, when something is published.
    const Silenced lcm;
    const uint8_t nothing = 0;
    lcm_publish(lcm_, "GENIO_RECONNECT", &nothing, 1);
  }
  if (connected()) tune();
  return connected();
}

Link::~Link() {
  if (lcm_) lcm_destroy(lcm_);
}

void Link::tune() {
  // LCM leaves Nagle's algorithm and delayed acknowledgements on: 88 ms a round trip.
  const int fd = lcm_get_fileno(lcm_);
  if (!tcp_ || fd < 0) return;
  const int one = 1;
  if (fd != tuned_fd_) setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  setsockopt(fd, IPPROTO_TCP, TCP_QUICKACK, &one, sizeof one);
  tuned_fd_ = fd;
}

void Link::subscribe(const std::string& channel, Handler handler) {
  subscriptions_.push_back({channel, std::move(handler)});
  if (lcm_) subscriptions_.back().subscribe(lcm_);
}

bool Link::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  if (!connect()) return false;
  std::optional<Silenced> lcm;
  if (tcp_ && is_closed(lcm_get_fileno(lcm_))) lcm.emplace();
  const bool sent = lcm_publish(lcm_, channel.c_str(), bytes.data(), unsigned(bytes.size())) == 0;
  tune();
  return sent;
}

bool Link::wait(int timeout_ms, int other_fd) {
  // LCM's own waiting functions would abort the process or block for ever without a connection.
  if (!connect()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(timeout_ms, 100)));
    return false;
  }
  const int fd = lcm_get_fileno(lcm_);
  pollfd polled[2] = {{fd, POLLIN, 0}, {other_fd, POLLIN, 0}};
  if (poll(polled, other_fd >= 0 ? 2 : 1, timeout_ms) <= 0) return true;
  if (!(polled[0].revents & (POLLIN | POLLHUP | POLLERR))) return true;
  std::optional<Silenced> lcm;
  if (tcp_ && is_closed(fd)) lcm.emplace();
  const bool good = lcm_handle(lcm_) == 0;
  tune();
  return good;
}

}  // namespace genio
