#include "server/hub/queues/fair_queue.hpp"

#include <gtest/gtest.h>

#include <string>

namespace genio {
namespace {

class FairQueue : public testing::Test {
 protected:
  void push(uint64_t sender, const std::string& text) {
    queue.push(sender, std::make_shared<const HubMessage>(
                           std::vector<char>(text.begin(), text.end()), held));
  }
  std::string pop() {
    const HubFairQueue::Message message = queue.pop();
    return {message->bytes().begin(), message->bytes().end()};
  }
  size_t held = 0;
  HubFairQueue queue;
};

TEST_F(FairQueue, MessagesOfOneSenderStayInTheirOrder) {
  for (const char* text : {"a", "b", "c", "d"}) push(1, text);
  std::string got;
  while (!queue.empty()) got += pop();
  EXPECT_EQ(got, "abcd");
}

TEST_F(FairQueue, ANewcomerGoesAfterTwoMessagesOfEachOtherAtMost) {
  for (int k = 0; k < 1000; ++k)
    for (uint64_t flooder = 1; flooder <= 5; ++flooder) push(flooder, "flood");
  for (int k = 0; k < 777; ++k) pop();
  push(9, "honest");
  int before = 0;
  while (pop() != "honest") ++before;
  EXPECT_LE(before, 10);
}

TEST_F(FairQueue, LargeMessagesCountForTheirBytes) {
  for (int k = 0; k < 100; ++k) push(1, std::string(36 << 10, 'L')), push(2, "s");
  int large = 0, small = 0;
  for (int k = 0; k < 55; ++k) ++(pop()[0] == 'L' ? large : small);
  EXPECT_NEAR(small, 50, 1);  // 36 kB and 4 for any message cost ten times as much as one of a byte
  EXPECT_NEAR(large, 5, 1);
}

TEST_F(FairQueue, WhoWasIdleHasNoCreditForIt) {
  for (int k = 0; k < 100; ++k) push(1, "a");
  for (int k = 0; k < 50; ++k) pop();
  for (int k = 0; k < 50; ++k) push(2, "b");
  int first = 0;
  for (int k = 0; k < 40; ++k) first += pop() == "a";
  EXPECT_NEAR(first, 20, 1);
}

TEST_F(FairQueue, TheHeaviestSenderIsForgottenAlone) {
  for (int k = 0; k < 10; ++k) push(1, "aaa"), push(2, std::string(1000, 'b'));
  EXPECT_EQ(queue.share(2).bytes, 10000u);
  const auto forgotten = queue.forget_heaviest();
  EXPECT_EQ(forgotten.sender, 2u);
  EXPECT_EQ(forgotten.share.messages, 10u);
  EXPECT_EQ(queue.messages(), 10u);
  EXPECT_EQ(queue.share(2).messages, 0u);
  while (!queue.empty()) EXPECT_EQ(pop(), "aaa");
  EXPECT_EQ(held, 0u);
}

TEST_F(FairQueue, NewcomersWithoutEndKeepNobodyFromHisTurn) {
  for (int k = 0; k < 10; ++k) push(1, "stays");
  int taken = 0;
  for (uint64_t sender = 2; sender < 200 && taken < 10; ++sender) {
    push(sender, "new");
    taken += pop() == "stays";
  }
  EXPECT_EQ(taken, 10);
}

TEST_F(FairQueue, AllNewcomersTogetherHaveTheShareOfOne) {
  for (uint64_t sender = 10; sender < 1000; ++sender)
    queue.push(sender, std::make_shared<const HubMessage>(std::vector<char>{'n'}, held), true);
  for (int k = 0; k < 50; ++k) push(1, "a"), push(2, "b");
  EXPECT_EQ(queue.newcomers().messages, 990u);
  int newcomers = 0;
  for (int k = 0; k < 150; ++k) newcomers += pop() == "n";
  EXPECT_NEAR(newcomers, 50, 2);
  while (!queue.empty()) pop();
  EXPECT_EQ(queue.newcomers().messages, 0u);
}

TEST_F(FairQueue, SendersWhoLeftCostNothing) {
  push(0, "waits");
  for (uint64_t sender = 1; sender < 100000; ++sender) {
    push(sender, "x");
    pop();
    if (sender % 1000 == 0) push(0, "waits");
  }
  EXPECT_LT(queue.senders(), 2000u);
}

}  // namespace
}  // namespace genio
