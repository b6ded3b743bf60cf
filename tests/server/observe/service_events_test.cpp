#include "server/observe/service_events.hpp"

#include <gtest/gtest.h>

#include "server/log/log_line.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

std::string text_of(const LogEvent& event) {
  const std::string line = log_line(event, 1, LogForm::text);
  return line.substr(line.find(' ') + 1);
}

TEST(ServiceEvents, AnAnswerSaysWhoseItIsAndWhatCameOfIt) {
  command_reply_t r{};
  r.id = "i", r.status = "converged", r.verdict = "explained", r.rms_mm = 0.25, r.wall_s = 1.5;
  EXPECT_EQ(text_of(reply_event("c", r)),
            "info answered id=i client=c status=converged verdict=explained rms_mm=0.25 "
            "seconds=1.5 waited_s=0\n");
  r = {};
  r.id = "i", r.status = "failed", r.message = "why not", r.tries = 2, r.waited_s = 3;
  EXPECT_EQ(text_of(reply_event("c", r)),
            "warning answered id=i client=c status=failed seconds=0 waited_s=3 tries=2 "
            "reason=\"why not\"\n");
}

TEST(ServiceEvents, ARefusalSaysWhomAndWhy) {
  command_reply_t r{};
  r.id = "i", r.status = "refused", r.message = "the queue is full";
  EXPECT_EQ(text_of(reply_event("c", r)),
            "info refused id=i client=c reason=\"the queue is full\"\n");
}

TEST(ServiceEvents, WhatBecameOfThoseThatWereThereAddsUp) {
  server_status_t told{}, last{};
  told.queued = 5, told.running = 2, told.replied = 10, told.refused = 1;
  last.replied = 12, last.refused = 1;
  const DrainCounts kept = drain_counts(told, last, true);
  EXPECT_EQ(kept.finished, 2);
  EXPECT_EQ(kept.refused, 0);
  EXPECT_EQ(kept.journalled, 5);
  last.replied = 17, last.refused = 6;
  const DrainCounts unkept = drain_counts(told, last, false);
  EXPECT_EQ(unkept.finished, 2);
  EXPECT_EQ(unkept.refused, 5);
  EXPECT_EQ(unkept.journalled, 0);
}

TEST(ServiceEvents, TheLastWordSaysWhatWasFinishedJournalledAndRefused) {
  server_status_t last{};
  last.received = 20, last.replied = 18, last.refused = 3, last.uptime_s = 60;
  EXPECT_EQ(text_of(stopped_event(last, {2, 1, 3}, 0.5)),
            "info stopped finished=2 journalled=1 refused=3 seconds=0.5 uptime_s=60 received=20 "
            "replied=18 refused_in_all=3\n");
}

TEST(ServiceEvents, TheFirstWordSaysWhatIsServed) {
  server_status_t s{};
  s.version = "1.2.3", s.model = {"a", "b"}, s.workers = 2;
  EXPECT_EQ(text_of(serving_event(s, {{"url", "u"}}, 1.5)),
            "info serving version=1.2.3 models=a,b workers=2 seconds=1.5 url=u\n");
}

TEST(ServiceEvents, EveryEventIsInThePageOfOperating) {
  const std::string page = test::content_of(GENIO_SOURCE_DIR "/docs/operating.md");
  ASSERT_FALSE(page.empty());
  for (int k = 0; k < int(LogKind::count); ++k)
    EXPECT_NE(page.find(std::string("| `") + name_of(LogKind(k)) + "` |"), page.npos)
        << name_of(LogKind(k));
}

TEST(ServiceEvents, AWorkerThatDiedIdleHasNoRequest) {
  EXPECT_EQ(text_of(worker_replaced_event("", "exit status 1")),
            "warning worker_replaced reason=\"exit status 1\"\n");
  EXPECT_EQ(text_of(worker_replaced_event("i", "exit status 1")),
            "warning worker_replaced id=i reason=\"exit status 1\"\n");
}

}  // namespace
}  // namespace genio
