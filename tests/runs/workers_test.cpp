#include "runs/process/workers.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <map>

#include "forward/base/types.hpp"
#include "runs/frames/frame_by_frame.hpp"

namespace genio {
namespace {

TEST(Workers, EveryFrameComesOnce) {
  constexpr size_t frames = 100;
  for (int count : {1, 2, 3, 7}) {
    std::map<std::string, int> came;
    in_processes(
        count,
        [&](int k, const Send& send) {
          const auto [first, end] = run_of_neighbours(frames, k, count);
          for (size_t i = first; i < end; ++i) send(std::to_string(i));
        },
        [&](const std::string& result) { ++came[result]; });
    EXPECT_EQ(came.size(), frames);
    for (const auto& [frame, times] : came) EXPECT_EQ(times, 1) << frame;
  }
}

TEST(Workers, RunsOfNeighboursFollowOneAnotherWithoutAGap) {
  for (size_t items : {0u, 1u, 5u, 100u})
    for (int count : {1, 3, 8}) {
      size_t next = 0;
      for (int k = 0; k < count; ++k) {
        const auto [first, end] = run_of_neighbours(items, k, count);
        EXPECT_EQ(first, next);
        EXPECT_LE(first, end);
        next = end;
      }
      EXPECT_EQ(next, items);
    }
}

TEST(Workers, ResultsArriveAsTheyWereSent) {
  const std::string results[] = {"", "one line\nand another\n", std::string(300000, 'x'),
                                 std::string("\0zero", 5)};
  std::vector<std::string> came;
  in_processes(
      2,
      [&](int k, const Send& send) {
        if (k == 0)
          for (const auto& r : results) send(r);
      },
      [&](const std::string& result) { came.push_back(result); });
  EXPECT_EQ(came, std::vector<std::string>(std::begin(results), std::end(results)));
}

TEST(Workers, OneThatDiesIsAnErrorAndTheOthersResultsStillCome) {
  int came = 0;
  const auto work = [](int k, const Send& send) {
    if (k == 0) throw std::runtime_error("on purpose");
    send("done");
  };
  EXPECT_THROW(in_processes(3, work, [&](const std::string&) { ++came; }), std::runtime_error);
  EXPECT_EQ(came, 2);
}

TEST(Workers, WhatOneThrowsIsThrownHereWithItsWords) {
  const auto work = [](int k, const Send&) {
    if (k == 1) throw InputError("out/frame00002.svg: cannot be written");
  };
  try {
    in_processes(3, work, [](const std::string&) {});
    FAIL() << "an error was lost";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "out/frame00002.svg: cannot be written");
  }
}

TEST(Workers, EachHasAProcessOfItsOwn) {
  std::map<std::string, int> processes;
  in_processes(
      3, [](int, const Send& send) { send(std::to_string(getpid())); },
      [&](const std::string& process) { ++processes[process]; });
  EXPECT_EQ(processes.size(), 3u);
  EXPECT_FALSE(processes.contains(std::to_string(getpid())));
}

TEST(WorkersInTurn, EachEndingIsToldAndAtMostSoManyRunAtOnce) {
  std::map<int, Ending> endings;
  int came = 0, now = 0, most = 0;
  const auto work = [](int k, const Send& send) {
    send("+");
    if (k == 1) throw InputError("bad");
    if (k == 2) throw std::runtime_error("failed");
    if (k == 3) raise(SIGKILL);
    send("done");
  };
  const auto collect = [&](const std::string& text) {
    if (text == "+") most = std::max(most, ++now);
    else ++came;
  };
  in_turn(6, 2, work, collect, [&](int k, const Ending& ending) { --now, endings[k] = ending; });
  EXPECT_EQ(came, 3);
  EXPECT_LE(most, 2);
  ASSERT_EQ(endings.size(), 6u);
  EXPECT_EQ(endings[0].how, How::done);
  EXPECT_EQ(endings[1].how, How::bad_input);
  EXPECT_EQ(endings[1].reason, "bad");
  EXPECT_EQ(endings[2].how, How::failed);
  EXPECT_EQ(endings[3].how, How::died);
  EXPECT_NE(endings[3].reason.find("signal 9"), std::string::npos) << endings[3].reason;
}

}  // namespace
}  // namespace genio
