// How a hub ends.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
using test::RawClient;

RawClient ready_reader(const Hub& hub, int receive_buffer = 0) {
  const size_t before = hub.counts().subscriptions;
  RawClient client = RawClient::greeted(hub.port(), receive_buffer);
  client.subscribe("A");
  EXPECT_TRUE(eventually([&] { return hub.counts().subscriptions > before; }));
  return client;
}

TEST(HubFlush, WhatWasPublishedBeforeReachesWhoReads) {
  for (int round = 0; round < 20; ++round) {
    Hub hub(0);
    RawClient reader = ready_reader(hub), publisher = RawClient::greeted(hub.port());
    for (int k = 0; k < 50; ++k) publisher.publish("A", std::to_string(k) + std::string(1000, ' '));
    hub.flush(milliseconds(5000));  // some of it is still in the system's buffers
    for (int k = 0; k < 50; ++k) {
      const auto message = reader.receive();
      ASSERT_TRUE(message) << round << ' ' << k;
      EXPECT_EQ(message->payload.substr(0, 2), (std::to_string(k) + " ").substr(0, 2));
    }
    EXPECT_TRUE(reader.sees_the_end());
    EXPECT_TRUE(publisher.sees_the_end());
  }
}

TEST(HubFlush, WaitsForAReaderOfLargeMessages) {
  Hub hub(0);
  RawClient reader = ready_reader(hub, 65536), publisher = RawClient::greeted(hub.port());
  const std::string payload(3 << 20, 'x');
  publisher.publish("A", payload);
  publisher.publish("A", payload);
  ASSERT_TRUE(eventually([&] { return hub.counts().messages_in == 2; }));
  size_t got = 0;
  std::thread reading([&] {
    while (reader.receive(milliseconds(2000))) ++got;
  });
  hub.flush(milliseconds(5000));
  reading.join();
  EXPECT_EQ(got, 2u);
}

TEST(HubFlush, IsNotHeldUpByWhoReadsNothing) {
  Hub hub(0);
  RawClient stuck = ready_reader(hub, 4096), reader = ready_reader(hub);
  RawClient publisher = RawClient::greeted(hub.port());
  publisher.publish("A", std::string(4 << 20, 'x'));
  ASSERT_TRUE(eventually([&] { return hub.counts().messages_in == 1; }));
  const Stopwatch watch;
  std::thread reading([&] { EXPECT_TRUE(reader.receive()); });
  hub.flush(milliseconds(20000));
  reading.join();
  EXPECT_LT(watch.seconds(), 10);
}

TEST(HubFlush, EndsInTimeThoughSomebodyReadsSlowlyOrFloods) {
  Hub hub(0);
  RawClient slow = ready_reader(hub, 4096), publisher = RawClient::greeted(hub.port());
  publisher.publish("A", std::string(4 << 20, 'x'));
  std::atomic<bool> stop{false};
  std::thread flooding([&] {
    const auto bytes = tcpq::publication("B", std::string(1000, 'f'));
    while (!stop && publisher.send(bytes)) {
    }
  });
  ASSERT_TRUE(eventually([&] { return hub.counts().messages_in > 10; }));
  const Stopwatch watch;
  std::thread trickling([&] {
    while (!stop) {
      slow.sip(10000);
      std::this_thread::sleep_for(milliseconds(10));
    }
  });
  hub.flush(milliseconds(300));
  EXPECT_GT(watch.seconds(), 0.2);  // it waits for who reads slowly
  EXPECT_LT(watch.seconds(), 5);
  stop = true;
  flooding.join();
  trickling.join();
}

TEST(HubFlush, NobodyIsTakenAfterwardsAndItMayBeCalledAgain) {
  Hub hub(0);
  RawClient reader = ready_reader(hub);
  hub.flush(milliseconds(1000));
  hub.flush(milliseconds(1000));
  EXPECT_FALSE(RawClient().connect(hub.port()));
  EXPECT_EQ(hub.counts().connections, 0u);
  EXPECT_EQ(hub.counts().accepted, 1u);
}

}  // namespace
}  // namespace genio
