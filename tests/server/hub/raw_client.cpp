#include "tests/server/hub/raw_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <thread>

#include "server/hub/protocol/tcpq.hpp"

namespace genio::test {
namespace {

using Clock = std::chrono::steady_clock;

uint32_t word(const std::string& bytes, size_t at) {
  return tcpq::word_at({bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + 4)},
                       0);
}

template <class T>
void set_option(int socket, int level, int option, const T& value) {
  setsockopt(socket, level, option, &value, sizeof value);
}

}  // namespace

bool eventually(const std::function<bool()>& is_true, milliseconds longest) {
  for (const auto end = Clock::now() + longest; Clock::now() < end;) {
    if (is_true()) return true;
    std::this_thread::sleep_for(milliseconds(2));
  }
  return is_true();
}

RawClient::RawClient(int receive_buffer) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  set_option(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, timeval{5, 0});
  set_option(socket_.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  if (receive_buffer > 0) set_option(socket_.get(), SOL_SOCKET, SO_RCVBUF, receive_buffer);
}

RawClient RawClient::greeted(uint16_t port, int receive_buffer) {
  RawClient client(receive_buffer);
  client.connect(port);
  client.greet();
  return client;
}

bool RawClient::connect(uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
}

bool RawClient::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0) return false;
    bytes.remove_prefix(size_t(count));
  }
  return true;
}

ssize_t RawClient::send_some(std::string_view bytes) {
  const ssize_t count =
      ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return count >= 0 ? count : errno == EAGAIN || errno == EWOULDBLOCK ? 0 : -1;
}

bool RawClient::greet() { return send(tcpq::greeting(tcpq::client_mark)); }

bool RawClient::subscribe(std::string_view pattern) { return send(tcpq::subscription(pattern)); }

bool RawClient::publish(std::string_view channel, std::string_view payload) {
  return send(tcpq::publication(channel, payload));
}

/// False when nothing came in time or the other side is gone.
bool RawClient::fill(milliseconds longest) {
  pollfd polled{socket_.get(), POLLIN, 0};
  if (ended_ || poll(&polled, 1, int(std::max(longest, milliseconds(0)).count())) <= 0)
    return false;
  std::array<char, 65536> buffer;
  const ssize_t count = recv(socket_.get(), buffer.data(), buffer.size(), 0);
  if (count <= 0) return ended_ = true, false;
  got_.append(buffer.data(), size_t(count));
  return true;
}

std::optional<RawClient::Message> RawClient::take() {
  constexpr size_t greeting = tcpq::greeting_bytes;
  if (got_.size() < greeting + 8) return std::nullopt;
  const size_t name = word(got_, greeting + 4), payload_at = greeting + 8 + name + 4;
  if (got_.size() < payload_at) return std::nullopt;
  const size_t size = word(got_, payload_at - 4);
  if (got_.size() < payload_at + size) return std::nullopt;
  Message message{got_.substr(greeting + 8, name), got_.substr(payload_at, size)};
  got_.erase(greeting, payload_at + size - greeting);  // the greeting stays in front
  return message;
}

std::optional<RawClient::Message> RawClient::receive(milliseconds longest) {
  const auto end = Clock::now() + longest;
  for (;;) {
    if (auto message = take()) return message;
    if (!fill(std::chrono::duration_cast<milliseconds>(end - Clock::now()))) return take();
  }
}

void RawClient::sip(size_t bytes) {
  std::vector<char> buffer(bytes);
  [[maybe_unused]] const auto count = recv(socket_.get(), buffer.data(), bytes, MSG_DONTWAIT);
}

uint16_t RawClient::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

bool RawClient::sees_the_end(milliseconds longest) {
  const auto end = Clock::now() + longest;
  while (!ended_ && Clock::now() < end) {
    fill(std::chrono::duration_cast<milliseconds>(end - Clock::now()));
    got_.resize(std::min(got_.size(), tcpq::greeting_bytes));
  }
  return ended_;
}

}  // namespace genio::test
