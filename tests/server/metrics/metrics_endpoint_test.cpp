// The endpoint beside clients that mean no good.

#include "server/metrics/metrics_endpoint.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "forward/base/elapsed.hpp"
#include "forward/base/types.hpp"
#include "server/metrics/http_request.hpp"
#include "tests/server/hub/few_descriptors.hpp"
#include "tests/server/hub/raw_client.hpp"
#include "tests/server/metrics/http_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::FewDescriptors;
using test::http_get;
using test::HttpClient;
using test::milliseconds;

size_t open_descriptors() {
  return size_t(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

bool is_answered(uint16_t port) { return http_get(port).ends_with("\r\n\r\nx 1\n"); }

class Metrics : public testing::Test {
 protected:
  void SetUp() override { endpoint.publish("x 1\n"); }
  MetricsEndpoint endpoint{0, {.request = milliseconds(500), .whole = milliseconds(1500)}};
  const uint16_t port = endpoint.port();
};

TEST_F(Metrics, TheNewestTextIsAnswered) {
  EXPECT_TRUE(is_answered(port));
  for (int k = 0; k < 10; ++k) endpoint.publish("y " + std::to_string(k) + "\n");
  EXPECT_TRUE(http_get(port).ends_with("\r\n\r\ny 9\n"));
  EXPECT_TRUE(http_get(port).ends_with("\r\n\r\ny 9\n"));
  EXPECT_TRUE(http_get(port, "/").starts_with("HTTP/1.1 404 "));
}

TEST(MetricsStart, BeforeTheFirstTextItSaysThatItIsTooEarly) {
  const MetricsEndpoint endpoint(0);
  EXPECT_TRUE(http_get(endpoint.port()).starts_with("HTTP/1.1 503 "));
}

TEST(MetricsStart, APortThatIsTakenIsAClearError) {
  const MetricsEndpoint first(0);
  try {
    const MetricsEndpoint second(first.port());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("port " + std::to_string(first.port())),
              std::string::npos);
  }
}

TEST(MetricsStart, APortIsFreeAgainAtOnce) {
  uint16_t port = 0;
  {
    MetricsEndpoint first(0);
    first.publish("x 1\n");
    port = first.port();
    EXPECT_TRUE(is_answered(port));
  }
  MetricsEndpoint second(port);
  second.publish("x 1\n");
  EXPECT_TRUE(is_answered(port));
}

TEST_F(Metrics, TwoHundredIdleConnectionsTakeSixteenPlacesAndNobodysAnswer) {
  const size_t before = open_descriptors();
  std::vector<HttpClient> idle;
  for (int k = 0; k < 200; ++k) {
    idle.emplace_back(port);
    ASSERT_TRUE(idle.back().connected());
  }
  EXPECT_TRUE(is_answered(port));
  EXPECT_LE(open_descriptors(), before + idle.size() + MetricsLimits{}.connections);
  idle.clear();
  EXPECT_TRUE(eventually([&] { return open_descriptors() <= before; }));
}

TEST_F(Metrics, WhoSendsAByteNowAndThenLosesThePlaceInTime) {
  std::vector<HttpClient> slow;
  for (int k = 0; k < 16; ++k) slow.emplace_back(port).send("GET /metrics HTTP/1.1\r\nA: ");
  EXPECT_TRUE(is_answered(port));
  const Stopwatch watch;
  bool taken = true;
  while (taken && watch.seconds() < 60) {
    std::this_thread::sleep_for(milliseconds(50));
    taken = false;
    for (HttpClient& c : slow) taken |= c.send("x");
  }
  EXPECT_FALSE(taken);
  EXPECT_TRUE(is_answered(port));
}

TEST_F(Metrics, HeadersWithoutEndAreRefused) {
  HttpClient client(port);
  client.send("GET /metrics HTTP/1.1\r\nA: " + std::string(longest_http_request, 'x'));
  EXPECT_TRUE(client.receive().starts_with("HTTP/1.1 431 "));
}

TEST_F(Metrics, WhoReadsNothingLosesTheConnection) {
  const size_t before = open_descriptors();
  endpoint.publish(std::string(64 << 20, 'x'));
  std::vector<HttpClient> greedy;
  for (int k = 0; k < 4; ++k) greedy.emplace_back(port).send("GET /metrics HTTP/1.1\r\n\r\n");
  endpoint.publish("x 1\n");
  EXPECT_TRUE(is_answered(port));
  EXPECT_TRUE(eventually([&] { return open_descriptors() <= before + greedy.size(); },
                         milliseconds(60000)));
}

TEST_F(Metrics, ARequestWithMoreBehindItIsAnsweredWhole) {
  HttpClient client(port);
  client.send("GET /metrics HTTP/1.1\r\n\r\n" + std::string(30000, 'x'));
  EXPECT_TRUE(client.receive().ends_with("\r\n\r\nx 1\n"));
}

TEST_F(Metrics, WithoutDescriptorsItGoesOnAfterwards) {
  std::vector<HttpClient> clients;
  clients.reserve(20);
  {
    const FewDescriptors few(4);
    for (int k = 0; k < 4; ++k) clients.emplace_back(port);
    std::this_thread::sleep_for(milliseconds(200));
  }
  clients.clear();
  EXPECT_TRUE(eventually([&] { return is_answered(port); }, milliseconds(30000)));
}

TEST_F(Metrics, PublishingGoesOnWhileAllAsk) {
  std::atomic<bool> done{false};
  std::thread asking([&] {
    for (int k = 0; k < 300; ++k) http_get(port);
    done = true;
  });
  int published = 0;
  for (; !done; ++published) endpoint.publish("x " + std::to_string(published) + "\n");
  asking.join();
  EXPECT_TRUE(http_get(port).ends_with("x " + std::to_string(published - 1) + "\n"));
}

}  // namespace
}  // namespace genio
