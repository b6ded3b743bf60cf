#include "server/udpm/incoming_parts.hpp"

#include <algorithm>

#include "server/udpm/datagram.hpp"

namespace genio {
namespace {

constexpr size_t digest_digits = 32;

}  // namespace

size_t IncomingParts::Unfinished::cost() const {
  return sizeof(Unfinished) + parts.size() * sizeof(std::vector<uint8_t>) + bytes;
}

bool IncomingParts::fits_its_message(const part_t& part) const {
  return part.data.size() <= limits_.message_bytes && part.count > 0 &&
         size_t(part.count) <= limits_.parts && part.index >= 0 && part.index < part.count &&
         !part.data.empty() && part.channel.size() <= udpm_longest_channel &&
         part.message.size() == digest_digits;
}

/// True for a part of a publication that was handed on before: somebody else missed it.
bool IncomingParts::is_late(const part_t& part) const {
  return std::any_of(finished_.begin(), finished_.end(), [&](const Finished& f) {
    return f.utime >= part.utime && f.digest == part.message;
  });
}

IncomingParts::Entry IncomingParts::find(const std::string& digest) {
  return std::find_if(unfinished_.begin(), unfinished_.end(),
                      [&](const Unfinished& u) { return u.digest == digest; });
}

void IncomingParts::erase(Entry entry) {
  held_ -= entry->cost();
  unfinished_.erase(entry);
}

IncomingParts::Entry IncomingParts::begin_message(const part_t& part, uint64_t source) {
  Unfinished message;
  message.digest = part.message, message.channel = part.channel, message.source = source;
  message.parts.resize(size_t(part.count)), message.missing = size_t(part.count);
  held_ += message.cost();
  unfinished_.push_back(std::move(message));
  return std::prev(unfinished_.end());
}

std::optional<WholeMessage> IncomingParts::take(part_t part, uint64_t source, UdpmTime now) {
  if (!fits_its_message(part)) return ++counts_.dropped(UdpmDrop::bad_part), std::nullopt;
  if (!wanted_(part.channel)) return std::nullopt;
  ++counts_.parts_in;
  auto whole = add(std::move(part), source, now);
  make_room(source);
  return whole;
}

std::optional<WholeMessage> IncomingParts::add(part_t part, uint64_t source, UdpmTime now) {
  if (is_late(part)) return ++counts_.repeated_parts, std::nullopt;
  Entry entry = find(part.message);
  if (entry == unfinished_.end()) entry = begin_message(part, source);
  if (entry->channel != part.channel || entry->parts.size() != size_t(part.count) ||
      entry->bytes + part.data.size() > limits_.message_bytes)
    return ++counts_.dropped(UdpmDrop::bad_part), std::nullopt;
  entry->utime = std::max(entry->utime, part.utime);
  auto& place = entry->parts[size_t(part.index)];
  if (!place.empty()) return ++counts_.repeated_parts, std::nullopt;
  entry->bytes += part.data.size(), held_ += part.data.size();
  place = std::move(part.data);
  entry->grew = now, entry->pause = limits_.first_ask, entry->ask_at = now + entry->pause;
  if (--entry->missing == 0) return join(entry, now);
  return std::nullopt;
}

/// Drops what has not grown for longest, first of the sender that has just sent.
void IncomingParts::make_room(uint64_t source) {
  const auto drop_while = [&](size_t share, const auto& counts) {
    for (;;) {
      size_t bytes = 0, messages = 0;
      Entry stillest = unfinished_.end();
      for (auto it = unfinished_.begin(); it != unfinished_.end(); ++it) {
        if (!counts(*it)) continue;
        bytes += it->cost(), ++messages;
        if (stillest == unfinished_.end() || it->grew < stillest->grew) stillest = it;
      }
      if (bytes * share <= limits_.unfinished_bytes &&
          messages * share <= limits_.unfinished_messages)
        return;
      erase(stillest);
      ++counts_.evicted;
    }
  };
  drop_while(2, [&](const Unfinished& u) { return u.source == source; });
  drop_while(1, [](const Unfinished&) { return true; });
}

std::optional<WholeMessage> IncomingParts::join(Entry entry, UdpmTime now) {
  WholeMessage whole{entry->channel, {}};
  whole.bytes.reserve(entry->bytes);
  for (const auto& part : entry->parts)
    whole.bytes.insert(whole.bytes.end(), part.begin(), part.end());
  if (message_digest(whole.channel, whole.bytes) != entry->digest) {
    ++counts_.wrong_digests;
    start_again(entry);
    return std::nullopt;
  }
  finish(*entry, now);
  erase(entry);
  ++counts_.joined;
  return whole;
}

/// One of the parts was wrong, and nobody knows which.
void IncomingParts::start_again(Entry entry) {
  held_ -= entry->bytes;
  for (auto& part : entry->parts) part = {};
  entry->bytes = 0, entry->missing = entry->parts.size();
}

void IncomingParts::finish(const Unfinished& message, UdpmTime now) {
  finished_.push_back({message.digest, message.utime, now});
  if (finished_.size() > limits_.finished_messages) finished_.pop_front();
}

std::optional<part_ask_t> IncomingParts::ask(UdpmTime now) {
  const auto due = std::find_if(unfinished_.begin(), unfinished_.end(),
                                [&](const Unfinished& u) { return u.ask_at <= now; });
  if (due == unfinished_.end()) return std::nullopt;
  due->pause = std::min<UdpmClock::duration>(2 * due->pause, limits_.longest_pause);
  due->ask_at = now + due->pause;
  part_ask_t ask{};
  ask.utime = now_us(), ask.message = due->digest;
  const size_t most = ask_capacity(limits_.datagram_bytes);
  for (size_t k = 0; k < due->parts.size() && ask.index.size() < most; ++k)
    if (due->parts[k].empty()) ask.index.push_back(int32_t(k));
  ask.count = int32_t(ask.index.size());
  ++counts_.asks_out;
  return ask;
}

std::optional<UdpmTime> IncomingParts::next_due() const {
  std::optional<UdpmTime> first;
  for (const Unfinished& u : unfinished_) first = std::min(first.value_or(u.ask_at), u.ask_at);
  return first;
}

void IncomingParts::forget_old(UdpmTime now) {
  for (auto it = unfinished_.begin(); it != unfinished_.end();) {
    const Entry entry = it++;
    if (now - entry->grew <= limits_.unfinished) continue;
    erase(entry);
    ++counts_.abandoned;
  }
  while (!finished_.empty() && now - finished_.front().at > limits_.finished) finished_.pop_front();
}

}  // namespace genio
