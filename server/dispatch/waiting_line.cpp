#include "server/dispatch/waiting_line.hpp"

namespace genio {

void WaitingLine::add(WaitingRequest request) {
  if (request.number < 0) request.number = number_++;
  const Turn turn{-request.priority, request.number};
  turns_[request.id] = turn;
  if (!request.stream.empty()) streams_[request.stream].insert(turn.second);
  bytes_ += request.bytes;
  by_turn_.emplace(turn, std::move(request));
}

void WaitingLine::remove(std::map<Turn, WaitingRequest>::iterator at) {
  const WaitingRequest& request = at->second;
  bytes_ -= request.bytes;
  turns_.erase(request.id);
  if (const auto stream = streams_.find(request.stream); stream != streams_.end()) {
    stream->second.erase(at->first.second);
    if (stream->second.empty()) streams_.erase(stream);
  }
  by_turn_.erase(at);
}

bool WaitingLine::remove(const std::string& id) {
  const auto turn = turns_.find(id);
  if (turn == turns_.end()) return false;
  remove(by_turn_.find(turn->second));
  return true;
}

std::optional<WaitingRequest> WaitingLine::next(const std::set<std::string>& busy) {
  for (auto it = by_turn_.begin(); it != by_turn_.end(); ++it) {
    const std::string& stream = it->second.stream;
    if (!stream.empty() &&
        (busy.contains(stream) || *streams_.at(stream).begin() != it->first.second))
      continue;
    WaitingRequest request = it->second;
    remove(it);
    return request;
  }
  return std::nullopt;
}

std::vector<std::string> WaitingLine::ids() const {
  std::vector<std::string> ids;
  for (const auto& [turn, request] : by_turn_) ids.push_back(request.id);
  return ids;
}

}  // namespace genio
