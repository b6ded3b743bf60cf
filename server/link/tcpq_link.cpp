#include "server/link/tcpq_link.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "forward/base/types.hpp"
#include "server/hub/limits.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "server/link/tcp_address.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds longest_attempt{1000};  // from its start to the hub's whole greeting
constexpr milliseconds longest_stall{5000};    // of a hub that takes nothing of what is sent
constexpr int longest_pause_ms = 100;          // between two tries where nobody listens
constexpr size_t read_at_once = 32 << 10;      // bytes
constexpr int receive_window = 16 << 10, receive_buffer = 256 << 10;  // bytes

int ms_of(std::chrono::steady_clock::duration time) {
  return int(std::max<int64_t>(0, std::chrono::ceil<milliseconds>(time).count()));
}

HubParser parser_of_hub() {
  const HubLimits limits;
  return {limits.name_bytes, limits.payload_bytes, tcpq::server_mark};
}

/// What happens at once; else LCM's protocol takes 88 ms a round trip.
void answer_at_once(int socket, int option) {
  const int one = 1;
  setsockopt(socket, IPPROTO_TCP, option, &one, sizeof one);
}

/// True where the other side is gone, and nothing that it sent is left.
bool is_closed(int socket) {
  char byte = 0;
  return recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

[[noreturn]] void refuse_hub(const std::string& url) {
  throw InputError(
      fmt::format("--lcm {}: cannot be used; expected for example tcpq://127.0.0.1:7700", url));
}

}  // namespace

TcpqLink::TcpqLink(const std::string& url)
    : url_(url), parser_(parser_of_hub()), buffer_(read_at_once) {
  if (!tcp_address(url)) refuse_hub(url);
  begin();
  while (stage_ == Stage::connecting || stage_ == Stage::greeting) {
    pollfd polled{socket_.get(), awaited(), 0};
    poll(&polled, 1, patience_ms(Clock::time_point::max()));
    go_on();
  }
}

uint16_t TcpqLink::local_port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (!connected() || getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
    return 0;
  return ntohs(address.sin_port);
}

void TcpqLink::close() {
  socket_.reset();
  stage_ = Stage::closed;
  ++connections_;
  unread_ = {};
  parser_ = parser_of_hub();
}

void TcpqLink::begin() {
  const TcpAddress to = tcp_address(url_).value();
  // A resolver may take long, so that it is asked until it knows the host, and not again.
  if (!host_) host_ = numeric_host(to.host);
  sockaddr_in address{};
  address.sin_family = AF_INET;  // as LCM
  address.sin_port = htons(to.port);
  if (!host_ || inet_pton(AF_INET, host_->c_str(), &address.sin_addr) != 1) return;
  socket_.reset(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket_) return;
  // What is on its way can no longer give way to what others send. A small buffer alone would make
  // the system drop small messages, which take much beside their bytes; a fixed one keeps the
  // window as it is.
  setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  setsockopt(socket_.get(), IPPROTO_TCP, TCP_WINDOW_CLAMP, &receive_window, sizeof receive_window);
  began_ = Clock::now();
  stage_ = Stage::connecting;
  if (::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return greet();
  if (errno != EINPROGRESS) close();
}

void TcpqLink::greet() {
  stage_ = Stage::greeting;
  answer_at_once(socket_.get(), TCP_NODELAY);
  send(tcpq::greeting(tcpq::client_mark));
}

/// As far as it comes without waiting.
void TcpqLink::go_on() {
  if (stage_ == Stage::connecting) {
    pollfd polled{socket_.get(), POLLOUT, 0};
    if (poll(&polled, 1, 0) != 1) return end_if_late();
    int error = 0;
    socklen_t size = sizeof error;
    if (getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size) != 0 || error != 0)
      return close();
    greet();
  }
  if (stage_ == Stage::greeting) receive(), end_if_late();
}

void TcpqLink::end_if_late() {
  if ((stage_ == Stage::connecting || stage_ == Stage::greeting) &&
      Clock::now() - began_ >= longest_attempt)
    close();
}

short TcpqLink::awaited() const { return stage_ == Stage::connecting ? POLLOUT : POLLIN; }

/// How long nothing needs to be done unless the socket is ready.
int TcpqLink::patience_ms(Clock::time_point until) const {
  if (!connected()) until = std::min(until, began_ + longest_attempt);
  return ms_of(until - Clock::now());
}

void TcpqLink::subscribe(const std::string& channel, Handler handler) {
  auto pattern = ChannelPattern::parse(channel);
  if (!pattern) throw InputError(fmt::format("channel '{}': no pattern of channels", channel));
  subscriptions_.push_back({std::move(*pattern), std::move(handler)});
  if (connected()) send(tcpq::subscription(channel));
}

bool TcpqLink::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  if (connected() && is_closed(socket_.get())) close();
  if (stage_ == Stage::closed) begin();
  go_on();
  if (!connected()) return false;
  return send(
      tcpq::publication(channel, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

/// Sends all of it, or parts with the hub.
bool TcpqLink::send(const std::vector<char>& bytes) {
  for (size_t sent = 0; sent < bytes.size();) {
    const auto n = ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n > 0) {
      sent += size_t(n);
      continue;
    }
    if (n < 0 && errno == EINTR) continue;
    pollfd polled{socket_.get(), POLLOUT, 0};
    const bool full = n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
    if (!full || poll(&polled, 1, ms_of(longest_stall)) != 1) return close(), false;
  }
  return true;
}

/// Handles what is there, up to the first message that somebody wants; true where there was one.
bool TcpqLink::receive() {
  if (unread_.empty()) {
    const auto n = recv(socket_.get(), buffer_.data(), buffer_.size(), 0);
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return false;
    if (n <= 0) return close(), false;
    answer_at_once(socket_.get(), TCP_QUICKACK);  // the system forgets it
    unread_ = {buffer_.data(), size_t(n)};
  }
  // A handler may publish, and so find the hub gone.
  for (const uint64_t connection = connections_; connection == connections_;) {
    const auto event = parser_.next(unread_);
    if (event && take(*event)) return true;
    if (event) continue;
    if (parser_.fault() != HubParser::Fault::none) close();
    break;
  }
  return false;
}

bool TcpqLink::take(const HubEvent& event) {
  if (event.kind == HubEvent::Kind::greeting) {
    stage_ = Stage::open;
    for (const Subscription& s : subscriptions_)
      if (!send(tcpq::subscription(s.pattern.text()))) break;
    return false;
  }
  if (event.kind != HubEvent::Kind::publish) return false;
  const std::string channel(event.name());
  const std::string_view payload = event.payload();
  bool called = false;
  for (const Subscription& s : subscriptions_) {
    if (!s.pattern.matches(channel)) continue;
    called = true;
    s.handler(channel, payload.data(), payload.size());
  }
  return called;
}

bool TcpqLink::wait(int timeout_ms, std::span<const int> others) {
  const auto until = Clock::now() + milliseconds(timeout_ms);
  std::vector<pollfd> polled;
  for (int fd : others) polled.push_back({fd, POLLIN, 0});
  if (stage_ == Stage::closed) begin();
  while (stage_ != Stage::closed) {
    polled.push_back({socket_.get(), awaited(), 0});
    const bool more = connected() && !unread_.empty();
    const int ready = poll(polled.data(), polled.size(), more ? 0 : patience_ms(until));
    const bool came = ready > 0 && polled.back().revents != 0;
    polled.pop_back();
    const bool called = (came || more) && connected() && receive();
    if (!connected()) go_on();
    if (called || ready < 0 || ready > int(came) || Clock::now() >= until) return connected();
  }
  poll(polled.data(), polled.size(), std::min(ms_of(until - Clock::now()), longest_pause_ms));
  return false;
}

}  // namespace genio
