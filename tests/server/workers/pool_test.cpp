// Worker processes that misbehave in every way.

#include "server/workers/pool.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <csignal>
#include <set>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/workers/worker_side.hpp"

namespace genio {
namespace {

/// Does what the model's number of an assignment says.
enum Misdeed : size_t { works, crashes, hangs, grows, exits, talks, waits };

void misbehave(const Assignment& a, WorkerPipe& pipe) {
  command_reply_t reply{};
  reply.status = "converged";
  switch (a.model) {
    case crashes:
      raise(SIGSEGV);
      break;
    case hangs:
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    case grows:
      for (std::vector<std::vector<char>> all;;) {
        all.emplace_back(1 << 20, 'x');
        pipe.withdrawn();
      }
    case exits:
      _exit(3);
    case talks:
      for (int k = 0; k < 3; ++k) pipe.tell_progress(k, 0.5), pipe.tell_improved(reply);
      break;
    case waits:
      while (!pipe.withdrawn()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      reply.status = "cancelled";
      break;
    default:
      break;
  }
  pipe.tell_answer(reply, a.start);
}

class Pool : public testing::Test {
 protected:
  void make(const WorkerLimits& limits) {
    nursery = std::make_unique<Nursery>([mb = limits.memory_mb](int socket) {
      limit_memory(mb);
      run_worker(socket, misbehave);
    });
    pool = std::make_unique<WorkerPool>(*nursery, limits);
  }
  /// Events until `until` holds, for a minute at most.
  template <class Until>
  std::vector<WorkerEvent> wait(const Until& until) {
    std::vector<WorkerEvent> all;
    while (!until(all) && clock.seconds() < 60) {
      pollfd polled{pool->descriptor(), POLLIN, 0};
      poll(&polled, 1, 50);
      for (WorkerEvent& e : pool->events(clock.seconds())) all.push_back(std::move(e));
    }
    return all;
  }
  void start(const std::string& id, size_t misdeed, std::vector<uint8_t> state = {}) {
    wait([&](const auto&) { return pool->idle(); });
    pool->start({id, misdeed, {}, 0, std::move(state)}, clock.seconds());
  }
  WorkerEvent end_of(const std::string& id) {
    const auto all = wait([&](const auto& events) {
      return !events.empty() && events.back().id == id &&
             events.back().kind != WorkerEvent::Kind::progress &&
             events.back().kind != WorkerEvent::Kind::improved;
    });
    if (!all.empty()) return all.back();
    ADD_FAILURE() << id << " did not end";
    return {WorkerEvent::Kind::progress, "none"};
  }
  Stopwatch clock;
  std::unique_ptr<Nursery> nursery;
  std::unique_ptr<WorkerPool> pool;
};

TEST_F(Pool, AnAnswerComesWithTheStateOfItsStream) {
  make({});
  start("a", works, {1, 2});
  const WorkerEvent end = end_of("a");
  EXPECT_EQ(end.kind, WorkerEvent::Kind::answer);
  EXPECT_EQ(end.reply.status, "converged");
  EXPECT_EQ(end.state, (std::vector<uint8_t>{1, 2}));
  EXPECT_TRUE(pool->idle());
}

TEST_F(Pool, ProgressAndTheBestSoFarComeBeforeTheAnswer) {
  make({});
  start("a", talks);
  const auto all = wait([](const auto& events) { return events.size() >= 7; });
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[4].kind, WorkerEvent::Kind::progress);
  EXPECT_EQ(all[4].iteration, 2);
  EXPECT_EQ(all[4].rms_mm, 0.5);
  EXPECT_EQ(all[5].kind, WorkerEvent::Kind::improved);
  EXPECT_EQ(all[6].kind, WorkerEvent::Kind::answer);
}

TEST_F(Pool, AWorkerThatCrashesHangsGrowsOrExitsIsReplacedAndOthersNoticeNothing) {
  make({.count = 2, .memory_mb = 200, .silence_s = 2});
  start("long", waits);
  const std::pair<size_t, const char*> misdeeds[] = {
      {crashes, "signal 11"}, {hangs, "no sign of life"}, {grows, "200 MB"}, {exits, "status 3"}};
  int64_t replaced = 0;
  for (const auto& [misdeed, reason] : misdeeds) {
    start("bad", misdeed);
    const WorkerEvent end = end_of("bad");
    EXPECT_EQ(end.kind, WorkerEvent::Kind::lost);
    EXPECT_NE(end.reason.find(reason), std::string::npos) << end.reason;
    EXPECT_EQ(pool->replaced(), ++replaced);
    start("good", works);
    EXPECT_EQ(end_of("good").kind, WorkerEvent::Kind::answer);
  }
  pool->withdraw("long");
  EXPECT_EQ(end_of("long").reply.status, "cancelled");
}

TEST_F(Pool, AWithdrawalReachesAWorkerAtItsWorkAndNotTheNextRequest) {
  make({});
  start("a", waits);
  pool->withdraw("b");
  EXPECT_TRUE(pool->events(clock.seconds()).empty());
  pool->withdraw("a"), pool->withdraw("a");
  EXPECT_EQ(end_of("a").reply.status, "cancelled");
  start("c", works);
  EXPECT_EQ(end_of("c").reply.status, "converged");
}

TEST_F(Pool, ALargeRequestIsSentWithoutWaitingForItsWorker) {
  make({});
  const std::vector<uint8_t> large(8 << 20, 7);
  start("a", works, large);
  EXPECT_EQ(end_of("a").state, large);
}

/// True while a process is there and no zombie.
bool lives(pid_t pid) { return kill(pid, 0) == 0; }

TEST_F(Pool, WorkersEndWithTheirService) {
  std::set<pid_t> born;
  nursery = std::make_unique<Nursery>([](int socket) { run_worker(socket, misbehave); });
  nursery->bear(), nursery->bear();
  while (born.size() < 2 && clock.seconds() < 60)
    for (const NurseryEvent& e : nursery->events()) born.insert(e.pid);
  ASSERT_EQ(born.size(), 2u);
  for (pid_t pid : born) EXPECT_TRUE(lives(pid));
  nursery.reset();
  for (pid_t pid : born) {
    while (lives(pid) && clock.seconds() < 60)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(lives(pid));
  }
}

TEST_F(Pool, TheDeathOfAnIdleWorkerIsToldWithItsReason) {
  nursery = std::make_unique<Nursery>([](int) { raise(SIGKILL); });
  pool = std::make_unique<WorkerPool>(*nursery, WorkerLimits{});
  const auto all = wait([](const auto& events) { return !events.empty(); });
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].kind, WorkerEvent::Kind::idle_lost);
  EXPECT_EQ(all[0].id, "");
  EXPECT_NE(all[0].reason.find("signal 9"), std::string::npos) << all[0].reason;
}

}  // namespace
}  // namespace genio
