// A sender and a receiver with a network between them that loses, doubles and swaps datagrams, on a
// clock of its own.

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "server/udpm/datagram.hpp"
#include "server/udpm/incoming_parts.hpp"
#include "server/udpm/outgoing_parts.hpp"
#include "server/udpm/pacer.hpp"
#include "tests/server/udpm/sample_parts.hpp"

namespace genio {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::sample_message;

class LossyExchange {
 public:
  explicit LossyExchange(double loss) : lost_(loss) {}

  void publish(const WholeMessage& message) { EXPECT_TRUE(outgoing_.add(message, ++utime_, now_)); }
  /// Whether all became whole in time; a step is 0.1 ms.
  bool arrive(size_t count, UdpmClock::duration longest) {
    const UdpmTime end = now_ + longest;
    for (; arrived.size() < count && now_ < end; now_ += microseconds(100)) step();
    return arrived.size() >= count;
  }
  double seconds_passed() const { return std::chrono::duration<double>(now_ - began_).count(); }
  size_t kept_bytes() const { return outgoing_.kept_bytes(); }
  UdpmCounts sender, receiver;
  std::vector<WholeMessage> arrived;

 private:
  void step() {
    outgoing_.forget_old(now_), incoming_.forget_old(now_);
    while (pacer_.is_free(now_)) {
      const auto part = outgoing_.next();
      if (!part) break;
      outgoing_.sent(now_);
      pacer_.spend(1400, now_);
      send(*part);
    }
    while (const auto ask = incoming_.ask(now_))
      if (!lost_(random_)) outgoing_.resend(*ask, now_);
    for (auto it = flying_.begin(); it != flying_.end() && it->first <= now_;
         it = flying_.erase(it))
      if (auto whole = incoming_.take(it->second, 1, now_)) arrived.push_back(std::move(*whole));
  }
  void send(const part_t& part) {
    const auto delay = [&] { return microseconds(100 + random_() % 1000); };
    if (!lost_(random_)) flying_.emplace(now_ + delay(), part);
    if (random_() % 50 == 0) flying_.emplace(now_ + delay(), part);
  }

  const UdpmTime began_{std::chrono::hours(1)};
  UdpmTime now_ = began_;
  const UdpmLimits limits_;
  OutgoingParts outgoing_{limits_, sender};
  IncomingParts incoming_{limits_, receiver, [](std::string_view) { return true; }};
  Pacer pacer_{limits_.bytes_per_s, limits_.burst_bytes};
  std::multimap<UdpmTime, part_t> flying_;
  std::mt19937 random_{1};
  std::bernoulli_distribution lost_;
  int64_t utime_ = 0;
};

TEST(LossyExchange, FourMebibytesComeThroughWhateverIsLost) {
  const auto message = sample_message(4 << 20);
  for (const double loss : {0.0, 0.01, 0.05, 0.3}) {
    LossyExchange exchange(loss);
    exchange.publish(message);
    ASSERT_TRUE(exchange.arrive(1, seconds(5))) << loss;
    EXPECT_TRUE(exchange.arrived[0].bytes == message.bytes);
    RecordProperty("seconds", std::to_string(exchange.seconds_passed()));
    EXPECT_LE(double(exchange.sender.resent), 3300 * 2 * loss);
  }
}

TEST(LossyExchange, ReplyOfUsualSizeTakesMillisecondsWhereAThousandGo) {
  LossyExchange exchange(0.05);
  for (unsigned k = 0; k < 1000; ++k) {
    const double before = exchange.seconds_passed();
    exchange.publish(sample_message(20000, k));
    ASSERT_TRUE(exchange.arrive(k + 1, milliseconds(600))) << k;
    EXPECT_LT(exchange.seconds_passed() - before, 0.5);
  }
  EXPECT_EQ(exchange.receiver.joined, 1000u);
}

TEST(LossyExchange, AShortMessageDoesNotWaitForLongOnes) {
  LossyExchange exchange(0);
  for (unsigned k = 0; k < 4; ++k) exchange.publish(sample_message(4 << 20, k));
  exchange.arrive(1, milliseconds(100));
  exchange.publish(sample_message(10000, 9));
  ASSERT_TRUE(exchange.arrive(1, milliseconds(30)));
  EXPECT_EQ(exchange.arrived[0].bytes.size(), 10000u);
  EXPECT_TRUE(exchange.arrive(5, seconds(10)));
  EXPECT_EQ(exchange.sender.resent, 0u);
}

/// Datagrams that a receiver loses which reads all that is there every `pause`, and of which the
/// system holds 208 kB, with 2304 bytes for each full datagram.
size_t overflow_with(milliseconds pause) {
  constexpr size_t held_most = 212992 / 2304;
  const UdpmLimits limits;
  Pacer pacer(limits.bytes_per_s, limits.burst_bytes);
  const UdpmTime begin{std::chrono::hours(1)};
  UdpmTime read = begin;
  size_t held = 0, lost = 0;
  for (UdpmTime now = begin; now < begin + seconds(1); now += microseconds(50)) {
    if (now - read >= pause) read = now, held = 0;
    for (; pacer.is_free(now); pacer.spend(1400, now)) held < held_most ? ++held : ++lost;
  }
  return lost;
}

TEST(LossyExchange, AReceiverThatPausesForTenMillisecondsLosesNothing) {
  EXPECT_EQ(overflow_with(milliseconds(10)), 0u);
  EXPECT_GT(overflow_with(milliseconds(40)), 0u);
}

TEST(LossyExchange, WhatIsKeptForOthersHasALimit) {
  LossyExchange exchange(0.05);
  for (unsigned k = 0; k < 20; ++k) {
    exchange.publish(sample_message(4 << 20, k));
    ASSERT_TRUE(exchange.arrive(k + 1, seconds(5)));
    exchange.arrived.back().bytes = {};
    EXPECT_LE(exchange.kept_bytes(), UdpmLimits{}.kept_bytes);
  }
  EXPECT_EQ(exchange.receiver.evicted, 0u);
}

}  // namespace
}  // namespace genio
