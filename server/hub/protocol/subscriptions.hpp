#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "server/hub/protocol/channel_pattern.hpp"

namespace genio {

/// The channels that one client of the hub wants.
class HubSubscriptions {
 public:
  /// At most `most` patterns, of which `most_programs` may need a program (ChannelPattern).
  HubSubscriptions(size_t most, size_t most_programs)
      : most_(most), most_programs_(most_programs) {}

  /// False where the pattern is refused: it is none, or one too many. The same pattern may come
  /// several times, and is then to be removed as often.
  bool add(std::string_view pattern);
  /// Removes it once; nothing happens where it is not there.
  void remove(std::string_view pattern);
  void clear();

  bool want(std::string_view channel) const;
  size_t size() const { return patterns_.size(); }
  /// Sum of the patterns' costs (ChannelPattern::cost).
  size_t cost() const { return cost_; }

 private:
  size_t most_, most_programs_;
  std::vector<ChannelPattern> patterns_;  // those without a program first, which match sooner
  size_t programs_ = 0, cost_ = 0;
};

}  // namespace genio
