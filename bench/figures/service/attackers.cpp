#include "bench/figures/service/attackers.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>

#include "server/hub/descriptor.hpp"
#include "server/hub/protocol/tcpq.hpp"

namespace genio::bench {
namespace {

std::string text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }

/// One connection, which sends without waiting for anything.
class AttackConnection {
 public:
  AttackConnection(const Attack& attack, uint16_t port) : attack_(attack), port_(port) { open(); }

  /// Bytes that were taken.
  size_t turn(uint64_t number) {
    if (!socket_) open();
    if (attack_.reads || attack_.leaves) read_some();
    if (waiting_.empty()) {
      if (attack_.leaves && sent_one_) return open(), 0;
      waiting_ = attack_.bytes(number), sent_one_ = !waiting_.empty();
    }
    return send_some();
  }

 private:
  void open() {
    socket_.reset(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sent_one_ = false, waiting_.clear();
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_port = htons(port_);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      return socket_.reset();
    if (attack_.greets) waiting_ = text(tcpq::greeting(tcpq::client_mark));
    if (attack_.subscribes) waiting_ += text(tcpq::subscription(".*"));
  }

  size_t send_some() {
    if (!socket_ || waiting_.empty()) return 0;
    const ssize_t n =
        send(socket_.get(), waiting_.data(), waiting_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0) {
      if (errno != EAGAIN && errno != EWOULDBLOCK) socket_.reset();
      return 0;
    }
    waiting_.erase(0, size_t(n));
    return size_t(n);
  }

  void read_some() {
    std::array<char, 1 << 16> unread;
    if (socket_) recv(socket_.get(), unread.data(), unread.size(), MSG_DONTWAIT);
  }

  const Attack& attack_;
  const uint16_t port_;
  Descriptor socket_;
  std::string waiting_;
  bool sent_one_ = false;
};

}  // namespace

Attackers::Attackers(const Attack& attack, uint16_t port)
    : attack_(attack), port_(port), thread_([this] { work(); }) {}

Attackers::~Attackers() {
  stop_ = true;
  thread_.join();
}

void Attackers::work() {
  std::vector<AttackConnection> connections;
  connections.reserve(size_t(attack_.connections));
  uint64_t number = 0;
  while (!stop_) {
    if (connections.size() < size_t(attack_.connections)) connections.emplace_back(attack_, port_);
    size_t taken = 0;
    for (AttackConnection& c : connections) taken += c.turn(number++);
    sent_ += taken;
    if (taken == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace genio::bench
