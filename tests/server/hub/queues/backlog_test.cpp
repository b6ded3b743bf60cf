#include "server/hub/queues/backlog.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <string>

#include "server/hub/descriptor.hpp"

namespace genio {
namespace {

class HubBacklogs : public testing::Test {
 protected:
  void SetUp() override {
    int pair[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair), 0);
    here.reset(pair[0]);
    there.reset(pair[1]);
  }
  std::shared_ptr<const HubMessage> message(const std::string& text) {
    return std::make_shared<const HubMessage>(std::vector<char>(text.begin(), text.end()), held);
  }
  std::string read_all() const {
    std::string text(1 << 20, ' ');
    const ssize_t count = read(there.get(), text.data(), text.size());
    return text.substr(0, size_t(std::max<ssize_t>(count, 0)));
  }
  size_t held = 0;
  Descriptor here, there;
};

TEST_F(HubBacklogs, SendInOrderWhateverTheyAreCutInto) {
  for (const size_t most : {1u, 2u, 3u, 5u, 100u}) {
    HubBacklog backlog(held);
    for (const char* text : {"ab", "c", "defg"}) backlog.push(message(text));
    std::string got;
    size_t ended = 0;
    for (int k = 0; k < 20 && !backlog.empty(); ++k) {
      const auto sent = backlog.send_to(here.get(), most);
      EXPECT_LE(sent.bytes, most);
      EXPECT_FALSE(sent.broken);
      ended += sent.messages;
      got += read_all();
    }
    EXPECT_EQ(got, "abcdefg");
    EXPECT_EQ(ended, 3u);
    EXPECT_EQ(backlog.bytes(), 0u);
    EXPECT_EQ(held, 0u);
  }
}

TEST_F(HubBacklogs, AMessageOfManyBacklogsIsHeldOnce) {
  const std::string text(100000, 'x');
  HubBacklog first(held), second(held);
  auto shared = message(text);
  const size_t one = held;
  EXPECT_GE(one, text.size());
  first.push(shared);
  second.push(shared);
  shared.reset();
  EXPECT_LT(held, one + 1000);
  EXPECT_GE(first.bytes(), text.size());
  first.clear();
  EXPECT_GE(held, text.size());
  second.clear();
  EXPECT_EQ(held, 0u);
}

TEST_F(HubBacklogs, TinyMessagesCountForWhatTheyTake) {
  HubBacklog backlog(held);
  for (int k = 0; k < 1000; ++k) backlog.push(message("x"));
  EXPECT_GE(held, 100u * 1000);  // allocations and entries of the queue
  EXPECT_GE(backlog.bytes(), 16u * 1000);
}

TEST_F(HubBacklogs, AFullSocketTakesNothingAndAClosedOneIsBroken) {
  HubBacklog backlog(held);
  backlog.push(message(std::string(8 << 20, 'x')));
  while (backlog.send_to(here.get(), 8 << 20).bytes > 0) {
  }
  EXPECT_FALSE(backlog.send_to(here.get(), 1).broken);
  EXPECT_GT(backlog.bytes(), 0u);
  there.reset();
  EXPECT_TRUE(backlog.send_to(here.get(), 1).broken);
}

}  // namespace
}  // namespace genio
