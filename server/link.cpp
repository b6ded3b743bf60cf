#include "server/link.hpp"

#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdlib>
#include <regex>
#include <thread>

#include "forward/base/types.hpp"

namespace genio {

struct Link::Subscription {
  Handler handler;
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

Link::Link(const std::string& url) : lcm_(lcm_create(url.c_str())), tcp_(url.starts_with("tcpq")) {
  if (!lcm_)
    throw InputError(fmt::format(
        "--lcm {}: cannot be used; expected for example {} or udpm://239.255.76.67:7667?ttl=0 "
        "(which needs a multicast route)",
        url, default_url));
  tune();
}

Link::~Link() { lcm_destroy(lcm_); }

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
  subscriptions_.push_back({std::move(handler)});
  lcm_subscribe(
      lcm_, channel.c_str(),
      [](const lcm_recv_buf_t* buffer, const char* name, void* user) {
        // No exception may pass through LCM's C frames.
        try {
          static_cast<Subscription*>(user)->handler(name, buffer->data, buffer->data_size);
        } catch (...) {
        }
      },
      &subscriptions_.back());
}

bool Link::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  const bool sent = lcm_publish(lcm_, channel.c_str(), bytes.data(), unsigned(bytes.size())) == 0;
  tune();
  return sent;
}

bool Link::wait(int timeout_ms, int other_fd) {
  int fd = lcm_get_fileno(lcm_);
  if (fd < 0) {
    // LCM reconnects, and subscribes again, when something is published; its own waiting
    // functions would abort the process or block for ever here.
    const uint8_t nothing = 0;
    lcm_publish(lcm_, "GENIO_RECONNECT", &nothing, 1);
    fd = lcm_get_fileno(lcm_);
    if (fd < 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(timeout_ms, 100)));
      return false;
    }
    tune();
  }
  pollfd polled[2] = {{fd, POLLIN, 0}, {other_fd, POLLIN, 0}};
  if (poll(polled, other_fd >= 0 ? 2 : 1, timeout_ms) <= 0) return true;
  if (!(polled[0].revents & (POLLIN | POLLHUP | POLLERR))) return true;
  const bool good = lcm_handle(lcm_) == 0;
  tune();
  return good;
}

}  // namespace genio
