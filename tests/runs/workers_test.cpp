#include "runs/process/workers.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

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

}  // namespace
}  // namespace genio
