#pragma once
#include <deque>
#include <list>
#include <optional>
#include <string>

#include "server/udpm/counts.hpp"
#include "server/udpm/limits.hpp"
#include "server/udpm/parts.hpp"

namespace genio {

/// Messages that are sent in parts, and kept for some time for those who miss parts. Who
/// has fewest parts left goes first, so that a reply does not wait for a long one, and receivers
/// hold few unfinished ones. It knows no socket.
class OutgoingParts {
 public:
  OutgoingParts(const UdpmLimits& limits, UdpmCounts& counts) : limits_(limits), counts_(counts) {}

  /// Takes a message that is to be sent; what is being sent already is not sent twice. `utime` must
  /// grow. False where there is no room until others are sent.
  bool add(WholeMessage message, int64_t utime, UdpmTime now);
  /// Sends parts again that somebody misses, as far as it has them.
  void resend(const part_ask_t& ask, UdpmTime now);

  bool any_wait() const { return !waiting_.empty(); }
  /// The part that is to be sent next; nothing where none waits.
  std::optional<part_t> next() const;
  /// The part that next() gives was sent.
  void sent(UdpmTime now);

  /// Forgets what was kept long enough.
  void forget_old(UdpmTime now);
  size_t kept_bytes() const { return kept_bytes_; }
  size_t kept_messages() const { return kept_.size(); }

 private:
  struct Kept {
    WholeMessage message;
    std::string digest;
    int64_t utime = 0;
    size_t capacity = 0;          // bytes of a part
    std::deque<int32_t> waiting;  // indices, in the order of sending
    std::vector<bool> waits;      // by index
    std::vector<uint8_t> sendings;
    UdpmTime sent{};
    size_t cost() const;
  };
  void enqueue(Kept& kept, int32_t index);
  std::list<Kept*>::const_iterator first() const;
  bool make_room(size_t bytes);
  std::list<Kept>::iterator find(const std::string& digest);
  void erase(std::list<Kept>::iterator kept);

  const UdpmLimits limits_;
  UdpmCounts& counts_;
  std::list<Kept> kept_;      // oldest publication first
  std::list<Kept*> waiting_;  // those that have parts waiting, in the order of their coming
  size_t kept_bytes_ = 0;
};

}  // namespace genio
