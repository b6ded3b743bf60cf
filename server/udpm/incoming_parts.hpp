#pragma once
#include <deque>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/udpm/counts.hpp"
#include "server/udpm/limits.hpp"
#include "server/udpm/parts.hpp"

namespace genio {

/// Joins the parts of messages, in whatever order and however often they come, also parts of
/// several publications of the same message. A sender holds half of the room at most: beyond it
/// goes the message of its own that has not grown for longest, and without room that of all. It
/// knows no socket.
class IncomingParts {
 public:
  /// `wanted`: whether anybody here wants messages of a channel.
  IncomingParts(const UdpmLimits& limits, UdpmCounts& counts,
                std::function<bool(std::string_view channel)> wanted)
      : limits_(limits), counts_(counts), wanted_(std::move(wanted)) {}

  /// Takes a part; `source` tells senders apart. The message that became whole with it, once for
  /// each time it was published.
  std::optional<WholeMessage> take(part_t part, uint64_t source, UdpmTime now);
  /// What is to be asked for now; the next call tells the next.
  std::optional<part_ask_t> ask(UdpmTime now);
  /// When there may be something to ask for, or to forget.
  std::optional<UdpmTime> next_due() const;
  /// Forgets what has not grown for too long.
  void forget_old(UdpmTime now);

  size_t held_bytes() const { return held_; }
  size_t unfinished() const { return unfinished_.size(); }

 private:
  struct Unfinished {
    std::string digest, channel;
    uint64_t source = 0;
    int64_t utime = 0;                        // of the newest publication of which a part came
    std::vector<std::vector<uint8_t>> parts;  // by index; empty: missing
    size_t missing = 0, bytes = 0;            // bytes: of the parts
    UdpmTime grew{}, ask_at{};
    UdpmClock::duration pause{};
    size_t cost() const;
  };
  struct Finished {
    std::string digest;
    int64_t utime = 0;
    UdpmTime at{};
  };
  using Entry = std::list<Unfinished>::iterator;

  bool fits_its_message(const part_t& part) const;
  bool is_late(const part_t& part) const;
  Entry find(const std::string& digest);
  Entry begin_message(const part_t& part, uint64_t source);
  std::optional<WholeMessage> add(part_t part, uint64_t source, UdpmTime now);
  void make_room(uint64_t source);
  std::optional<WholeMessage> join(Entry entry, UdpmTime now);
  void start_again(Entry entry);
  void erase(Entry entry);
  void finish(const Unfinished& message, UdpmTime now);

  const UdpmLimits limits_;
  UdpmCounts& counts_;
  const std::function<bool(std::string_view)> wanted_;
  std::list<Unfinished> unfinished_;
  std::deque<Finished> finished_;  // oldest first
  size_t held_ = 0;
};

}  // namespace genio
