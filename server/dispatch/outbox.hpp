#pragma once
#include <string>
#include <utility>
#include <vector>

#include "server/dispatch/record.hpp"
#include "server/dispatch/replies.hpp"

namespace genio {

/// A reply, for those who watch the service. `client` asked first.
struct ReplyNote {
  std::string client;
  command_reply_t reply;
};

/// A message that nobody could be told about.
struct DropNote {
  const char* channel;
  size_t bytes;
  std::string reason;
};

/// What happened since it was last taken: records to be kept before the messages are published.
struct Outgoing {
  std::vector<Record> records;
  std::vector<OutgoingMessage> messages;
  bool empty() const { return records.empty() && messages.empty(); }
};

/// Collects what a dispatcher has to say, and to whom.
class Outbox {
 public:
  /// Records are dropped where nobody keeps them.
  explicit Outbox(bool kept) : kept_(kept) {}

  void reply(const std::string& client, std::vector<uint8_t> reply,
             Passage passage = Passage::in_order) {
    outgoing_.messages.push_back({"GENIO_REPLY." + client, std::move(reply), {}, passage});
  }
  /// `acknowledges`: id of a request, where the message says that it was taken.
  void progress(const std::string& client, const progress_t& progress,
                std::string acknowledges = {}) {
    const Passage passage = acknowledges.empty() ? Passage::if_room : Passage::in_order;
    outgoing_.messages.push_back(
        {"GENIO_PROGRESS." + client, encode(progress), std::move(acknowledges), passage});
  }
  void keep(Record record) {
    if (kept_) outgoing_.records.push_back(std::move(record));
  }
  Outgoing take() { return std::exchange(outgoing_, Outgoing{}); }

  void note(const std::string& client, command_reply_t reply) {
    notes_.push_back({client, std::move(reply)});
  }
  void note_drop(const char* channel, size_t bytes, std::string reason) {
    drops_.push_back({channel, bytes, std::move(reason)});
  }
  std::vector<ReplyNote> take_notes() { return std::exchange(notes_, {}); }
  std::vector<DropNote> take_drops() { return std::exchange(drops_, {}); }

 private:
  bool kept_;
  Outgoing outgoing_;
  std::vector<ReplyNote> notes_;
  std::vector<DropNote> drops_;
};

}  // namespace genio
