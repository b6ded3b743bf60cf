#include "server/link/udpm_link.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <exception>
#include <system_error>

#include "forward/base/types.hpp"
#include "server/udpm/datagram.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr int most_at_once = 64;          // datagrams that are read before others have their turn
constexpr milliseconds refused_pause{5};  // before the system is asked again to send
constexpr milliseconds longest_leave{5000}, quiet_leave{250};

[[noreturn]] void refuse_group(const std::string& url, const std::string& why) {
  throw InputError(
      fmt::format("--lcm {}: cannot be used ({}); expected for example "
                  "udpm://239.255.76.67:7667?ttl=0 and a multicast route",
                  url, why));
}

UdpmAddress address_of(const std::string& url) {
  std::string why;
  const auto address = udpm_address(url, why);
  if (!address) refuse_group(url, why);
  return *address;
}

MulticastSocket socket_of(const std::string& url, const UdpmAddress& address) {
  try {
    return MulticastSocket(address);
  } catch (const std::system_error& e) {
    refuse_group(url, e.what());
  }
}

uint64_t number_of(const sockaddr_in& source) {
  return uint64_t(source.sin_addr.s_addr) << 16 | source.sin_port;
}

}  // namespace

UdpmLink::UdpmLink(const std::string& url, const UdpmLimits& limits)
    : limits_(limits),
      address_(address_of(url)),
      socket_(socket_of(url, address_)),
      outgoing_(limits_, counts_),
      incoming_(limits_, counts_, [this](std::string_view channel) { return is_wanted(channel); }),
      pacer_(limits.bytes_per_s, limits.burst_bytes) {}

UdpmLink::~UdpmLink() { take_leave(); }

UdpmCounts UdpmLink::counts() const {
  UdpmCounts counts = counts_;
  counts.overflowed = socket_.overflowed();
  return counts;
}

bool UdpmLink::is_wanted(std::string_view channel) const {
  return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                     [&](const Subscription& s) { return s.pattern.matches(channel); });
}

void UdpmLink::subscribe(const std::string& channel, Handler handler) {
  auto pattern = ChannelPattern::parse(channel);
  if (!pattern) throw InputError(fmt::format("channel '{}': no pattern of channels", channel));
  subscriptions_.push_back({std::move(*pattern), std::move(handler)});
}

/// Grows with every message, also when the clock is turned back.
int64_t UdpmLink::next_utime() { return last_utime_ = std::max(now_us(), last_utime_ + 1); }

bool UdpmLink::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  const UdpmTime now = UdpmClock::now();
  if (channel.size() > udpm_longest_channel || bytes.size() > limits_.message_bytes)
    return ++counts_.unsendable, true;
  if (datagram_bytes(channel, bytes.size()) <= limits_.datagram_bytes)
    return send_datagram(channel, bytes, now);
  if (!outgoing_.add({channel, bytes}, next_utime(), now)) return false;
  send_waiting();
  return true;
}

bool UdpmLink::send_datagram(std::string_view channel, std::span<const uint8_t> payload,
                             UdpmTime now) {
  const auto bytes = make_datagram(number_, channel, payload);
  if (!socket_.send(bytes)) return false;
  ++number_, ++counts_.datagrams_out;
  pacer_.spend(bytes.size(), now);
  return true;
}

/// Sends what may go now; false where the system took no more.
bool UdpmLink::send_waiting() {
  UdpmTime now = UdpmClock::now();
  outgoing_.forget_old(now), incoming_.forget_old(now);
  if (now < retry_at_) return false;
  while (const auto ask = incoming_.ask(now)) send_datagram(part_ask_channel, encode(*ask), now);
  while (pacer_.is_free(now)) {
    const auto part = outgoing_.next();
    if (!part) return true;
    if (!send_datagram(part_channel, encode(*part), now)) {
      retry_at_ = now + refused_pause;
      return false;
    }
    outgoing_.sent(now);
    part_sent_ = now;
    now = UdpmClock::now();
  }
  return true;
}

/// When there is something to send, if nothing comes until then.
UdpmTime UdpmLink::next_turn(UdpmTime now) const {
  UdpmTime turn = incoming_.next_due().value_or(UdpmTime::max());
  if (outgoing_.any_wait()) turn = std::min(turn, pacer_.free_at(now));
  return std::max(turn, retry_at_);
}

bool UdpmLink::wait(int timeout_ms, std::span<const int> others) {
  const UdpmTime end = UdpmClock::now() + milliseconds(timeout_ms);
  std::vector<pollfd> polled{{socket_.descriptor(), POLLIN, 0}};
  for (int fd : others) polled.push_back({fd, POLLIN, 0});
  for (;;) {
    send_waiting();
    const UdpmTime now = UdpmClock::now();
    const auto left = std::chrono::nanoseconds(std::min(end, next_turn(now)) - now);
    const int64_t ns = std::max<int64_t>(left.count(), 0);
    const timespec longest{time_t(ns / 1000000000), long(ns % 1000000000)};
    const int ready = ppoll(polled.data(), polled.size(), &longest, nullptr);
    const bool came = ready > 0 && polled[0].revents != 0 && receive();
    const bool others_ready = ready > int(polled[0].revents != 0);
    if (came || others_ready || ready < 0 || UdpmClock::now() >= end) return true;
  }
}

/// Handles datagrams that are there; true where a handler was called.
bool UdpmLink::receive() {
  bool called = false;
  for (int k = 0; k < most_at_once; ++k) {
    const auto received = socket_.receive();
    if (!received) break;
    ++counts_.datagrams_in;
    called |= handle(*received, UdpmClock::now());
  }
  return called;
}

bool UdpmLink::handle(const MulticastSocket::Received& received, UdpmTime now) {
  if (address_.ttl == 0 && !local_hosts_.contain(received.source.sin_addr, now))
    return ++counts_.dropped(UdpmDrop::foreign), false;
  auto why = UdpmDrop::not_lcm;
  const auto datagram = read_datagram(received.bytes, why);
  if (!datagram) return ++counts_.dropped(why), false;
  const auto payload = datagram->payload;
  std::string fault;
  if (datagram->channel == part_channel) {
    auto part = decode_checked<part_t>(payload.data(), payload.size(), fault);
    if (!part) return ++counts_.dropped(UdpmDrop::bad_part), false;
    const auto whole = incoming_.take(std::move(*part), number_of(received.source), now);
    return whole && hand_over(whole->channel, whole->bytes);
  }
  if (datagram->channel == part_ask_channel) {
    const auto ask = decode_checked<part_ask_t>(payload.data(), payload.size(), fault);
    if (ask) outgoing_.resend(*ask, now);
    else ++counts_.dropped(UdpmDrop::bad_part);
    return false;
  }
  return hand_over(std::string(datagram->channel), payload);
}

bool UdpmLink::hand_over(const std::string& channel, std::span<const uint8_t> bytes) {
  bool called = false;
  for (Subscription& s : subscriptions_) {
    if (!s.pattern.matches(channel)) continue;
    called = true;
    // As with LCM, where no exception may pass.
    try {
      s.handler(channel, bytes.data(), bytes.size());
    } catch (...) {
    }
  }
  return called;
}

void UdpmLink::take_leave() noexcept {
  try {
    subscriptions_.clear();
    const UdpmTime end = UdpmClock::now() + longest_leave;
    const auto is_needed = [&](UdpmTime now) {
      return now < end && (outgoing_.any_wait() || now - part_sent_ < quiet_leave);
    };
    while (is_needed(UdpmClock::now())) wait(10, {});
  } catch (const std::exception&) {
    // Who misses parts asks for the whole again.
  }
}

}  // namespace genio
