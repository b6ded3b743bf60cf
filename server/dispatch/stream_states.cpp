#include "server/dispatch/stream_states.hpp"

namespace genio {

const std::vector<uint8_t>& StreamStates::find(const std::string& stream) const {
  static const std::vector<uint8_t> none;
  const auto it = kept_.find(stream);
  return it == kept_.end() ? none : it->second.state;
}

void StreamStates::forget(const std::string& stream) {
  const auto it = kept_.find(stream);
  if (it == kept_.end()) return;
  bytes_ -= it->second.state.size();
  ages_.erase(it->second.age);
  kept_.erase(it);
}

void StreamStates::keep(const std::string& stream, std::vector<uint8_t> state) {
  forget(stream);
  if (state.empty() || state.size() > most_bytes_) return;
  bytes_ += state.size();
  ages_.push_back(stream);
  kept_[stream] = {std::move(state), std::prev(ages_.end())};
  while (kept_.size() > most_ || bytes_ > most_bytes_) forget(std::string(ages_.front()));
}

}  // namespace genio
