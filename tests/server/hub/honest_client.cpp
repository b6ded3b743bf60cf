#include "tests/server/hub/honest_client.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "forward/base/elapsed.hpp"

namespace genio::test {

HonestClient::HonestClient(uint16_t port, const std::string& channel)
    : channel_(channel),
      publisher_("tcpq://127.0.0.1:" + std::to_string(port)),
      subscriber_("tcpq://127.0.0.1:" + std::to_string(port)) {
  subscriber_.subscribe(channel, [this](const std::string&, const void* data, size_t size) {
    if (size == sizeof received_) std::memcpy(&received_, data, size);
  });
  // The subscription takes its way while the first message takes another.
  const Stopwatch watch;
  while (received_ == 0 && 1e3 * watch.seconds() < no_answer) {
    std::vector<uint8_t> bytes(sizeof sent_);
    std::memcpy(bytes.data(), &++sent_, sizeof sent_);
    publisher_.publish(channel_, bytes);
    subscriber_.wait(20);
  }
}

double HonestClient::one_way_ms() {
  std::vector<uint8_t> bytes(sizeof sent_);
  std::memcpy(bytes.data(), &++sent_, sizeof sent_);
  const Stopwatch watch;
  publisher_.publish(channel_, bytes);
  while (received_ != sent_ && 1e3 * watch.seconds() < no_answer) subscriber_.wait(50);
  return received_ == sent_ ? 1e3 * watch.seconds() : no_answer;
}

std::vector<double> HonestClient::times_for(double for_ms) {
  std::vector<double> times;
  const Stopwatch watch;
  while (1e3 * watch.seconds() < for_ms) times.push_back(one_way_ms());
  return times;
}

double worst_of(std::vector<double> times) {
  if (times.empty()) return HonestClient::no_answer;
  std::sort(times.begin(), times.end());
  testing::Test::RecordProperty("messages", std::to_string(times.size()));
  testing::Test::RecordProperty("median_ms", std::to_string(times[times.size() / 2]));
  testing::Test::RecordProperty("worst_ms", std::to_string(times.back()));
  return times.back();
}

}  // namespace genio::test
