// A hub whose memory runs out. All allocations of the test program pass through here.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "server/hub/hub.hpp"
#include "server/hub/protocol/tcpq.hpp"
#include "tests/server/hub/raw_client.hpp"

namespace {

std::atomic<size_t> smallest_refused{SIZE_MAX};
thread_local bool never_refused = false;

/// While it lives, other threads get no memory in pieces of so many bytes or more.
class MemoryShort {
 public:
  explicit MemoryShort(size_t smallest) {
    never_refused = true;
    smallest_refused = smallest;
  }
  ~MemoryShort() { smallest_refused = SIZE_MAX; }
  MemoryShort(const MemoryShort&) = delete;
  MemoryShort& operator=(const MemoryShort&) = delete;
};

}  // namespace

[[gnu::noinline]] void* operator new(size_t size) {
  if (size >= smallest_refused && !never_refused) throw std::bad_alloc();
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept { std::free(memory); }

namespace genio {
namespace {

using test::eventually;
using test::milliseconds;
using test::RawClient;

bool serves(const Hub& hub) {
  RawClient client = RawClient::greeted(hub.port());
  client.subscribe("OTHER");
  client.publish("OTHER", "x");
  return client.receive().has_value();
}

TEST(HubMemory, AMessageForWhichThereIsNoneCostsItsSenderOnly) {
  const Hub hub(0);
  RawClient reader = RawClient::greeted(hub.port()), sender = RawClient::greeted(hub.port());
  reader.subscribe(".*");
  ASSERT_TRUE(eventually([&] { return hub.counts().subscriptions == 1; }));
  const auto large = tcpq::publication("A", std::string(4 << 20, 'x'));
  {
    const MemoryShort less(3 << 20);
    sender.send(large);
    EXPECT_TRUE(sender.sees_the_end());
    EXPECT_TRUE(serves(hub));
  }
  EXPECT_EQ(hub.counts().dropped(HubDrop::out_of_memory), 1u);
  EXPECT_EQ(hub.counts().partial_bytes, 0u);
  const auto message = reader.receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->channel, "OTHER");
  RawClient again = RawClient::greeted(hub.port());
  again.send(large);
  ASSERT_TRUE(reader.receive());
}

TEST(HubMemory, WithNoneAtAllTheHubOutlivesIt) {
  const Hub hub(0);
  std::vector<RawClient> clients;
  for (int k = 0; k < 5; ++k) clients.push_back(RawClient::greeted(hub.port()));
  for (RawClient& c : clients) c.subscribe("A.*");
  ASSERT_TRUE(eventually([&] { return hub.counts().subscriptions == 5; }));
  const auto message = tcpq::publication("A", "x"), pattern = tcpq::subscription("(a|b)");
  std::vector<RawClient> newcomers(5);
  {
    const MemoryShort none(1);
    clients[0].send(message);
    clients[1].send(pattern);
    EXPECT_TRUE(clients[0].sees_the_end());
    EXPECT_TRUE(clients[1].sees_the_end());
    for (RawClient& c : newcomers) {
      ASSERT_TRUE(c.connect(hub.port()));
      c.greet();
      EXPECT_TRUE(c.sees_the_end());
    }
    EXPECT_FALSE(clients[2].sees_the_end(milliseconds(50)));
  }
  EXPECT_EQ(hub.counts().dropped(HubDrop::out_of_memory), 7u);
  EXPECT_TRUE(serves(hub));
}

}  // namespace
}  // namespace genio
