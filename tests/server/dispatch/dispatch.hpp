#pragma once
// A dispatcher, and what is told to it and by it.

#include <gtest/gtest.h>

#include "server/dispatch/dispatcher.hpp"

namespace genio::test {

class Dispatch : public testing::Test {
 protected:
  void ask(const shape_request_t& r) {
    const auto bytes = encode(r);
    dispatcher.receive_request(bytes.data(), bytes.size(), now_us());
  }
  void ask(const std::string& id, const std::string& client = "c", double deadline_s = 0) {
    shape_request_t r{};
    r.id = id, r.client = client, r.deadline_s = deadline_s;
    ask(r);
  }
  void cancel(const std::string& id, const std::string& client = "c") {
    cancel_t c{};
    c.id = id, c.client = client;
    const auto bytes = encode(c);
    dispatcher.receive_cancel(bytes.data(), bytes.size(), now_us());
  }
  void answer(const std::string& id, double rms_mm) {
    command_reply_t reply{};
    reply.id = id, reply.status = "converged", reply.rms_mm = rms_mm;
    dispatcher.finish(id, reply, {}, now_us());
  }
  struct Reply {
    std::string client;
    command_reply_t reply;
  };
  /// Those that are to be published now.
  std::vector<Reply> replies() {
    std::vector<Reply> result;
    const std::string prefix = "GENIO_REPLY.";
    for (const OutgoingMessage& m : dispatcher.take_outgoing().messages) {
      if (!m.channel.starts_with(prefix)) continue;
      std::string why;
      const auto reply = decode_checked<command_reply_t>(m.bytes.data(), m.bytes.size(), why);
      EXPECT_TRUE(reply) << why;
      result.push_back({m.channel.substr(prefix.size()), reply.value()});
    }
    return result;
  }
  /// The id of the next request, which runs from now on; empty: there is none.
  std::string next() {
    const auto assignment = dispatcher.next(now_us());
    return assignment ? assignment->id : "";
  }
  server_status_t counts(const Dispatcher& of) const {
    server_status_t s{};
    return of.tell(s), s;
  }
  server_status_t counts() const { return counts(dispatcher); }
  const std::vector<ModelIdentity> models = {{"adult", "a1"}, {"child", "c1"}};
  Dispatcher dispatcher{{.waiting = 2, .remembered = 2}, models};
};

}  // namespace genio::test
