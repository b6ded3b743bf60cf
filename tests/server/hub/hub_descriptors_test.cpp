// A hub in a process that has no descriptors left.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/hub/hub.hpp"
#include "tests/server/hub/few_descriptors.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace genio {
namespace {

using test::eventually;
using test::FewDescriptors;
using test::milliseconds;
using test::RawClient;

/// Whether the process comes to rest: it takes nearly no processor time for some 0.2 s.
/// Threads of a linear algebra library spin when a process begins, so that it has several tries;
/// a loop that never waits is busy in every one.
bool comes_to_rest() {
  for (int tries = 0; tries < 20; ++tries) {
    const double before = processor_seconds();
    std::this_thread::sleep_for(milliseconds(200));
    if (processor_seconds() - before < 0.02) return true;
  }
  return false;
}

bool gets_its_own_message(RawClient& client) {
  client.subscribe("A");
  client.publish("A", "x");
  return client.receive().has_value();
}

TEST(HubDescriptors, EachNewcomerTakesThePlaceOfTheLeastUseful) {
  const Hub hub(0);
  std::vector<RawClient> useful(2), idle(30);
  RawClient newcomer;  // its socket exists before descriptors run out
  const FewDescriptors few(5);
  for (RawClient& c : useful) {
    ASSERT_TRUE(c.connect(hub.port()) && c.greet());
    ASSERT_TRUE(gets_its_own_message(c));
  }
  for (RawClient& c : idle) ASSERT_TRUE(c.connect(hub.port()) && c.greet());
  ASSERT_TRUE(newcomer.connect(hub.port()) && newcomer.greet());
  EXPECT_TRUE(gets_its_own_message(newcomer));
  for (RawClient& c : useful) EXPECT_TRUE(gets_its_own_message(c));
  EXPECT_TRUE(eventually([&] { return hub.counts().accepted == 33; }));
  EXPECT_EQ(hub.counts().connections, 5u);
  EXPECT_EQ(hub.counts().dropped(HubDrop::displaced), 28u);
  EXPECT_EQ(hub.counts().dropped(HubDrop::out_of_descriptors), 28u);
  EXPECT_TRUE(comes_to_rest());
}

TEST(HubDescriptors, WithNoneAtAllNewcomersAreTurnedAwayAndLaterOnesServed) {
  const Hub hub(0);
  std::vector<RawClient> early(3);
  RawClient late;
  {
    const FewDescriptors few(0);
    for (RawClient& c : early) {
      ASSERT_TRUE(c.connect(hub.port()) && c.greet());
      EXPECT_TRUE(c.sees_the_end());
    }
    EXPECT_TRUE(comes_to_rest());
  }
  EXPECT_EQ(hub.counts().dropped(HubDrop::out_of_descriptors), 3u);
  ASSERT_TRUE(late.connect(hub.port()) && late.greet());
  EXPECT_TRUE(gets_its_own_message(late));
}

TEST(HubDescriptors, WithoutEvenTheReserveNewcomersWaitAndTheHubIsNotBusy) {
  const Hub hub(0);
  RawClient early;
  {
    FewDescriptors few(0);
    few.take_all();
    ASSERT_TRUE(early.connect(hub.port()) && early.greet());
    EXPECT_TRUE(comes_to_rest());
    EXPECT_EQ(hub.counts().accepted, 0u);
  }
  EXPECT_TRUE(gets_its_own_message(early));
}

TEST(HubDescriptors, AHubTakesHalfOfThemAtMost) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  rlimit lower = before;
  lower.rlim_cur = 200;
  setrlimit(RLIMIT_NOFILE, &lower);
  const Hub hub(0);
  setrlimit(RLIMIT_NOFILE, &before);
  std::vector<RawClient> clients(120);
  for (RawClient& c : clients) ASSERT_TRUE(c.connect(hub.port()) && c.greet());
  EXPECT_TRUE(eventually([&] { return hub.counts().accepted == 120; }));
  EXPECT_EQ(hub.counts().connections, 100u);
}

}  // namespace
}  // namespace genio
