#include "server/dispatch/entry.hpp"

#include <algorithm>

namespace genio {

bool RequestEntry::asked_by(const std::string& client) const {
  return std::find(clients.begin(), clients.end(), client) != clients.end();
}

void stamp(const RequestEntry& entry, const ModelIdentity& model, int64_t now,
           command_reply_t& reply) {
  const shape_request_t& r = entry.request;
  reply.id = r.id, reply.utime = now_us();
  reply.model = model.name, reply.model_hash = model.hash;
  reply.stream = r.stream, reply.label = r.label, reply.time_s = r.time_s;
  reply.waited_s = 1e-6 * double((entry.started > 0 ? entry.started : now) - entry.accepted);
  reply.tries = entry.tries + (entry.started > 0);
}

std::string stream_of(const RequestEntry& entry, const ModelIdentity& model) {
  if (entry.request.stream.empty()) return "";
  return entry.clients.front() + '\n' + entry.request.stream + '\n' + model.name;
}

}  // namespace genio
