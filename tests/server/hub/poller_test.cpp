#include "server/hub/poller.hpp"

#include <gtest/gtest.h>
#include <sys/eventfd.h>

#include <set>

namespace genio {
namespace {

Descriptor readable() { return Descriptor(eventfd(1, EFD_CLOEXEC | EFD_NONBLOCK)); }

std::set<uint64_t> numbers(std::span<const epoll_event> events) {
  std::set<uint64_t> all;
  for (const epoll_event& event : events) all.insert(event.data.u64);
  return all;
}

TEST(Poller, WhoCanWaitIsReportedOnlyWhereAllAreAskedFor) {
  Poller poller(10);
  const Descriptor a = readable(), b = readable(), c = readable();
  ASSERT_TRUE(poller.watch(a.get(), 1, EPOLLIN, false, Poller::Order::always));
  ASSERT_TRUE(poller.watch(b.get(), 2, EPOLLIN, false, Poller::Order::with_time));
  ASSERT_TRUE(poller.watch(c.get(), 3, EPOLLIN, false, Poller::Order::with_time));
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(numbers(poller.wait_for_some(0)), std::set<uint64_t>{1});
    EXPECT_EQ(numbers(poller.wait_for_all(0)), (std::set<uint64_t>{1, 2, 3}));
  }
  ASSERT_TRUE(poller.watch(a.get(), 1, 0, true, Poller::Order::always));
  EXPECT_TRUE(poller.wait_for_some(0).empty());
  EXPECT_EQ(numbers(poller.wait_for_all(-1)), (std::set<uint64_t>{2, 3}));
}

TEST(Poller, ADescriptorMayChangeItsOrder) {
  Poller poller(10);
  const Descriptor a = readable();
  ASSERT_TRUE(poller.watch(a.get(), 1, EPOLLIN, false, Poller::Order::with_time));
  EXPECT_TRUE(poller.wait_for_some(0).empty());
  poller.forget(a.get(), Poller::Order::with_time);
  EXPECT_TRUE(poller.wait_for_all(0).empty());
  ASSERT_TRUE(poller.watch(a.get(), 1, EPOLLIN, false, Poller::Order::always));
  EXPECT_EQ(numbers(poller.wait_for_some(0)), std::set<uint64_t>{1});
}

}  // namespace
}  // namespace genio
