#include "server/hub/protocol/parser.hpp"

#include <algorithm>
#include <utility>

namespace genio {
namespace {

constexpr size_t growth = 4;
constexpr size_t header_bytes = 2 * tcpq::word_bytes;  // type, length of the name

}  // namespace

std::string_view HubEvent::name() const {
  if (kind == Kind::greeting) return {};
  return {frame.data() + header_bytes, name_bytes};
}

std::string_view HubEvent::payload() const {
  if (kind != Kind::publish) return {};
  const size_t begin = header_bytes + name_bytes + tcpq::word_bytes;
  return {frame.data() + begin, frame.size() - begin};
}

/// Bytes of the event as far as can be told from those that are here: either all of it, or as many
/// as tell more.
size_t HubParser::needed() {
  if (frame_.size() < header_bytes) return header_bytes;
  const uint32_t type = tcpq::word_at(frame_, 0), name = tcpq::word_at(frame_, tcpq::word_bytes);
  if (!greeted_) {
    if (type != mark_) fault_ = Fault::malformed;
    return tcpq::greeting_bytes;
  }
  if (type < tcpq::publish || type > tcpq::unsubscribe) fault_ = Fault::malformed;
  else if (name > max_name_)
    fault_ = type == tcpq::publish ? Fault::too_large : Fault::long_pattern;
  if (fault_ != Fault::none) return header_bytes;
  const size_t name_end = header_bytes + size_t(name);
  return type == tcpq::publish ? needed_of_publication(name_end) : name_end;
}

size_t HubParser::needed_of_publication(size_t name_end) {
  const size_t begin = name_end + tcpq::word_bytes;
  if (frame_.size() < begin) return begin;
  const size_t payload = tcpq::word_at(frame_, name_end);
  if (payload > max_payload_) fault_ = Fault::too_large;
  return begin + payload;
}

void HubParser::take(std::string_view& bytes, size_t needed) {
  const size_t count = std::min(needed - frame_.size(), bytes.size());
  const size_t size = frame_.size() + count;
  // Memory grows with what came, not with what is claimed, and ends at the claimed size. In few
  // steps, since memory that is given back and taken again costs more than copying.
  if (size > frame_.capacity()) frame_.reserve(std::min(needed, growth * size));
  frame_.insert(frame_.end(), bytes.begin(), bytes.begin() + std::ptrdiff_t(count));
  bytes.remove_prefix(count);
}

HubEvent HubParser::finish() {
  HubEvent event;
  if (std::exchange(greeted_, true)) {
    const uint32_t type = tcpq::word_at(frame_, 0);
    event.kind = type == tcpq::publish     ? HubEvent::Kind::publish
                 : type == tcpq::subscribe ? HubEvent::Kind::subscribe
                                           : HubEvent::Kind::unsubscribe;
    event.name_bytes = tcpq::word_at(frame_, tcpq::word_bytes);
  }
  event.frame = std::exchange(frame_, {});
  return event;
}

std::optional<HubEvent> HubParser::next(std::string_view& bytes) {
  while (fault_ == Fault::none) {
    const size_t need = needed();
    if (fault_ != Fault::none) break;
    if (frame_.size() == need) return finish();
    if (bytes.empty()) return std::nullopt;
    take(bytes, need);
  }
  return std::nullopt;
}

void HubParser::abandon() {
  frame_ = std::vector<char>();  // gives the memory back, as {} would not
  if (fault_ == Fault::none) fault_ = Fault::malformed;
}

}  // namespace genio
