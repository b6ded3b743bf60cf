#include "server/hub/protocol/subscriptions.hpp"

#include <algorithm>
#include <utility>

namespace genio {

bool HubSubscriptions::add(std::string_view text) {
  if (patterns_.size() >= most_) return false;
  auto pattern = ChannelPattern::parse(text);
  if (!pattern) return false;
  const bool program = pattern->has_program();
  if (program && programs_ >= most_programs_) return false;
  const size_t cost = pattern->cost();
  patterns_.insert(program ? patterns_.end() : patterns_.begin(), std::move(*pattern));
  programs_ += program;
  cost_ += cost;
  return true;
}

void HubSubscriptions::remove(std::string_view text) {
  const auto found = std::find_if(patterns_.begin(), patterns_.end(),
                                  [&](const ChannelPattern& p) { return p.text() == text; });
  if (found == patterns_.end()) return;
  programs_ -= found->has_program();
  cost_ -= found->cost();
  patterns_.erase(found);
}

void HubSubscriptions::clear() {
  patterns_ = std::vector<ChannelPattern>();
  programs_ = cost_ = 0;
}

bool HubSubscriptions::want(std::string_view channel) const {
  return std::any_of(patterns_.begin(), patterns_.end(),
                     [&](const ChannelPattern& p) { return p.matches(channel); });
}

}  // namespace genio
