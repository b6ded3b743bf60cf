#include "server/dispatch/waiting_line.hpp"

#include <algorithm>

namespace genio {

void WaitingLine::add(WaitingRequest request) {
  Share& share = clients_[request.client];
  ++share.count;
  if (request.place.number < 0) {
    share.round = std::max(round_, share.round) + 1;
    request.place = {share.round, number_++};
  }
  const Turn turn{-request.priority, request.place.round, request.place.number};
  turns_[request.id] = turn;
  if (!request.stream.empty()) streams_[request.stream].insert(request.place.number);
  bytes_ += request.bytes;
  by_turn_.emplace(turn, std::move(request));
}

void WaitingLine::remove(std::map<Turn, WaitingRequest>::iterator at) {
  const WaitingRequest& request = at->second;
  bytes_ -= request.bytes;
  turns_.erase(request.id);
  if (const auto stream = streams_.find(request.stream); stream != streams_.end()) {
    stream->second.erase(request.place.number);
    if (stream->second.empty()) streams_.erase(stream);
  }
  if (const auto share = clients_.find(request.client); --share->second.count == 0)
    clients_.erase(share);
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
        (busy.contains(stream) || *streams_.at(stream).begin() != it->second.place.number))
      continue;
    WaitingRequest request = it->second;
    round_ = std::max(round_, request.place.round);
    remove(it);
    return request;
  }
  return std::nullopt;
}

size_t WaitingLine::size_of(const std::string& client) const {
  const auto share = clients_.find(client);
  return share == clients_.end() ? 0 : share->second.count;
}

std::vector<std::string> WaitingLine::ids() const {
  std::vector<std::string> ids;
  for (const auto& [turn, request] : by_turn_) ids.push_back(request.id);
  return ids;
}

}  // namespace genio
