#include "server/workers/frame_pipe.hpp"

#include <gtest/gtest.h>

#include "server/wire/body.hpp"

namespace genio {
namespace {

TEST(FramePipe, MessagesComeWholeHoweverTheirBytesAreCut) {
  const std::vector<WorkerMessage> sent = {
      {WorkerWord::compute, {1, 2, 3}}, {WorkerWord::alive, {}}, {WorkerWord::answer, {4}}};
  std::vector<uint8_t> bytes;
  for (const WorkerMessage& m : sent) {
    const auto more = packed(m);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  for (size_t step = 1; step <= bytes.size(); ++step) {
    MessageAssembler assembler;
    std::vector<WorkerMessage> came;
    for (size_t at = 0; at < bytes.size(); at += step) {
      assembler.add(bytes.data() + at, std::min(step, bytes.size() - at));
      while (auto message = assembler.next()) came.push_back(*message);
    }
    ASSERT_EQ(came.size(), sent.size());
    for (size_t k = 0; k < sent.size(); ++k) {
      EXPECT_EQ(came[k].word, sent[k].word);
      EXPECT_EQ(came[k].body, sent[k].body);
    }
  }
}

TEST(FramePipe, BytesThatAreNoMessageAreAnError) {
  MessageAssembler unknown_word, huge;
  const std::vector<uint8_t> bad = {99, 0, 0, 0, 0}, large = {0, 0xff, 0xff, 0xff, 0xff};
  unknown_word.add(bad.data(), bad.size()), huge.add(large.data(), large.size());
  EXPECT_THROW(unknown_word.next(), std::runtime_error);
  EXPECT_THROW(huge.next(), std::runtime_error);
}

TEST(Body, ValuesComeBackInTheirOrderAndNotBeyondTheEnd) {
  const std::vector<uint8_t> two = {1, 2}, none;
  const auto bytes = BodyWriter().add(2.5).add(int64_t(-7)).add(two).add(none).take();
  BodyReader body(bytes);
  EXPECT_EQ(body.number(), 2.5);
  EXPECT_EQ(body.integer(), -7);
  EXPECT_EQ(body.block(), (std::vector<uint8_t>{1, 2}));
  EXPECT_TRUE(body.block().empty());
  EXPECT_THROW(body.number(), std::runtime_error);
  for (size_t n = 0; n < bytes.size(); ++n) {
    const std::vector<uint8_t> part(bytes.begin(), bytes.begin() + std::ptrdiff_t(n));
    BodyReader shorter(part);
    const auto read_all = [&] {
      shorter.number(), shorter.integer(), shorter.block(), shorter.block();
    };
    EXPECT_THROW(read_all(), std::runtime_error) << n;
  }
}

}  // namespace
}  // namespace genio
