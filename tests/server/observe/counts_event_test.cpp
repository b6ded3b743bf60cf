#include "server/observe/counts_event.hpp"

#include <gtest/gtest.h>

#include <map>

namespace genio {
namespace {

std::map<std::string, int64_t> counts_in(const LogEvent& event) {
  std::map<std::string, int64_t> counts;
  for (const LogField& f : event.fields)
    if (const auto* value = std::get_if<int64_t>(&f.value)) counts[f.name] = *value;
  return counts;
}

TEST(CountsEvent, TellsOnceAMinuteWhatHasGrown) {
  CountsEvent counts;
  server_status_t s{};
  HubCounts hub;
  s.received = 5, s.replied = 4, s.queued = 1, s.forged_dropped = 2;
  hub.accepted = 7, hub.dropped(HubDrop::stalled) = 3, hub.messages_in = 60;
  EXPECT_FALSE(counts.due(s, &hub, 59.9));
  const auto first = counts.due(s, &hub, 60);
  ASSERT_TRUE(first);
  EXPECT_EQ(counts_in(*first), (std::map<std::string, int64_t>{{"received", 5},
                                                               {"replied", 4},
                                                               {"forged", 2},
                                                               {"connections", 7},
                                                               {"stalled", 3},
                                                               {"queued", 1},
                                                               {"running", 0},
                                                               {"workers", 0}}));
  s.received = 6;
  EXPECT_FALSE(counts.due(s, &hub, 100));
  const auto second = counts.due(s, &hub, 121);
  ASSERT_TRUE(second);
  EXPECT_EQ(counts_in(*second).at("received"), 1);
  EXPECT_FALSE(counts_in(*second).contains("replied"));
}

TEST(CountsEvent, IsSilentWhereNothingHasChanged) {
  CountsEvent counts;
  server_status_t s{};
  HubCounts hub;
  for (int minute = 1; minute < 100; ++minute) {
    hub.messages_in += 60, hub.bytes_in += 6000;  // the status itself
    s.uptime_s += 60, s.memory_mb = 100 + minute % 2;
    EXPECT_FALSE(counts.due(s, &hub, 60 * minute));
  }
}

TEST(CountsEvent, EveryCountOfTheStatusIsTold) {
  for (const auto counters : {request_counters(), message_drops()})
    for (const StatusCounter& c : counters) {
      CountsEvent counts;
      server_status_t s{};
      s.*c.field = 3;
      const auto event = counts.due(s, nullptr, 60);
      ASSERT_TRUE(event) << c.name;
      EXPECT_EQ(counts_in(*event).at(c.name), 3);
    }
}

TEST(CountsEvent, TroublesOfTheConnectionAreToldAndNotItsTraffic) {
  CountsEvent counts;
  LinkCounts link{.failed_handlings = 2, .udpm = UdpmCounts{}};
  link.udpm->datagrams_in = 100, link.udpm->datagrams_out = 60;
  link.udpm->overflowed = 3, link.udpm->dropped(UdpmDrop::foreign) = 4;
  const auto first = counts.due({}, nullptr, 60, link);
  ASSERT_TRUE(first);
  EXPECT_EQ(counts_in(*first), (std::map<std::string, int64_t>{{"failed_handlings", 2},
                                                               {"udpm_overflowed", 3},
                                                               {"foreign", 4},
                                                               {"queued", 0},
                                                               {"running", 0},
                                                               {"workers", 0}}));
  link.udpm->datagrams_in += 60, link.udpm->datagrams_out += 60;
  EXPECT_FALSE(counts.due({}, nullptr, 120, link));
}

}  // namespace
}  // namespace genio
