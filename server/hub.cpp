#include "server/hub.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <list>
#include <regex>
#include <stdexcept>
#include <vector>

namespace genio {
namespace {

// The protocol of LCM's tcpq provider (lcm_tcpq.c): big-endian 32-bit words.
constexpr uint32_t magic_server = 0x287617fa, magic_client = 0x287617fb, version = 0x0100;
constexpr uint32_t type_publish = 1, type_subscribe = 2, type_unsubscribe = 3;
constexpr size_t max_channel = 256, max_payload = 16u << 20, max_backlog = 64u << 20;
constexpr size_t max_connections = 256;

uint32_t word_at(const std::string& b, size_t at) {
  uint32_t v;
  std::memcpy(&v, b.data() + at, 4);
  return ntohl(v);
}

void append_word(std::string& b, uint32_t v) {
  v = htonl(v);
  b.append(reinterpret_cast<const char*>(&v), 4);
}

}  // namespace

struct Hub::Connection {
  struct Subscription {
    std::string channel;
    std::regex pattern;
  };
  int fd;
  std::string in, out;
  size_t taken = 0;  // bytes of `in` already understood
  bool greeted = false, closed = false;
  std::list<Subscription> subscriptions;

  bool wants(const std::string& channel) const {
    for (const auto& s : subscriptions)
      if (s.channel == channel || std::regex_match(channel, s.pattern)) return true;
    return false;
  }
  void subscribe(const std::string& channel) {
    try {
      subscriptions.push_back({channel, std::regex(channel)});
    } catch (const std::regex_error&) {
      subscriptions.push_back({channel, std::regex()});  // matches by name alone
    }
  }
  void flush() {
    while (!out.empty()) {
      const ssize_t n = send(fd, out.data(), out.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n > 0) out.erase(0, size_t(n));
      else if (n < 0 && errno == EINTR) continue;
      else {
        if (errno != EAGAIN && errno != EWOULDBLOCK) closed = true;
        return;
      }
    }
  }
  /// One complete message from `in`; false when more bytes are needed.
  bool take(uint32_t& type, std::string& channel, std::string& payload) {
    const size_t have = in.size() - taken;
    if (have < 8) return false;
    type = word_at(in, taken);
    const uint32_t name = word_at(in, taken + 4);
    if (type < type_publish || type > type_unsubscribe || name > max_channel)
      return closed = true, false;
    size_t need = 8 + size_t(name);
    if (type == type_publish) {
      if (have < need + 4) return false;
      const uint32_t size = word_at(in, taken + need);
      if (size > max_payload) return closed = true, false;
      if (have < need + 4 + size) return false;
      payload = in.substr(taken + need + 4, size);
      need += 4 + size_t(size);
    } else if (have < need) {
      return false;
    }
    channel = in.substr(taken + 8, name);
    taken += need;
    return true;
  }
};

Hub::Hub(uint16_t port) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int one = 1;
  setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener_, 64) != 0) {
    const std::string reason = std::strerror(errno);
    close(listener_);
    throw std::runtime_error("127.0.0.1:" + std::to_string(port) + ": " + reason);
  }
  socklen_t length = sizeof address;
  getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
  port_ = ntohs(address.sin_port);
  wake_ = eventfd(0, EFD_CLOEXEC);
  thread_ = std::thread([this] { run(); });
}

Hub::~Hub() {
  const uint64_t one = 1;
  if (write(wake_, &one, sizeof one) != sizeof one) std::abort();
  thread_.join();
  close(listener_);
  close(wake_);
}

void Hub::run() {
  std::list<Connection> connections;
  const auto relay = [&](const std::string& channel, const std::string& payload) {
    std::string frame;
    append_word(frame, type_publish);
    append_word(frame, uint32_t(channel.size()));
    frame += channel;
    append_word(frame, uint32_t(payload.size()));
    frame += payload;
    for (auto& c : connections) {
      if (!c.greeted || !c.wants(channel)) continue;
      if (c.out.size() + frame.size() > max_backlog) c.closed = true;  // a reader that never reads
      else c.out += frame, c.flush();
    }
  };
  const auto understand = [&](Connection& c) {
    if (!c.greeted) {
      if (c.in.size() < 8) return;
      if (word_at(c.in, 0) != magic_client) return void(c.closed = true);
      c.greeted = true, c.taken = 8;
    }
    uint32_t type = 0;
    for (std::string channel, payload; !c.closed && c.take(type, channel, payload);) {
      if (type == type_publish) relay(channel, payload);
      else if (type == type_subscribe) c.subscribe(channel);
      else
        for (auto it = c.subscriptions.begin(); it != c.subscriptions.end(); ++it)
          if (it->channel == channel) {
            c.subscriptions.erase(it);
            break;
          }
    }
    c.in.erase(0, c.taken);
    c.taken = 0;
  };
  for (;;) {
    std::vector<pollfd> polled = {{wake_, POLLIN, 0}, {listener_, POLLIN, 0}};
    for (auto& c : connections)
      polled.push_back({c.fd, short(POLLIN | (c.out.empty() ? 0 : POLLOUT)), 0});
    if (poll(polled.data(), polled.size(), -1) < 0 && errno != EINTR) return;
    if (polled[0].revents) break;
    size_t i = 2;
    for (auto it = connections.begin(); it != connections.end(); ++it, ++i) {
      if (polled[i].revents & POLLOUT) it->flush();
      if (!(polled[i].revents & (POLLIN | POLLHUP | POLLERR))) continue;
      char buffer[65536];
      const ssize_t n = recv(it->fd, buffer, sizeof buffer, MSG_DONTWAIT);
      if (n > 0) {
        it->in.append(buffer, size_t(n));
        understand(*it);
      } else if (n == 0 || (errno != EAGAIN && errno != EINTR)) {
        it->closed = true;
      }
    }
    connections.remove_if([](Connection& c) {
      if (c.closed) close(c.fd);
      return c.closed;
    });
    if (polled[1].revents & POLLIN) {
      const int fd = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (fd >= 0 && connections.size() >= max_connections) close(fd);
      else if (fd >= 0) {
        const int one = 1;
        setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
        Connection c{};
        c.fd = fd;
        append_word(c.out, magic_server);
        append_word(c.out, version);
        c.flush();
        connections.push_back(std::move(c));
      }
    }
  }
  for (auto& c : connections) close(c.fd);
}

}  // namespace genio
