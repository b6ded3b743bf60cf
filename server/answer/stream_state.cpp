#include "server/answer/stream_state.hpp"

#include "server/wire/body.hpp"

namespace genio {
namespace {

void add_vector(BodyWriter& body, const Vector& v) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(v.data());
  body.add(std::vector<uint8_t>(bytes, bytes + size_t(v.size()) * sizeof(double)));
}

Vector vector_of(const std::vector<uint8_t>& bytes) {
  Vector v(Eigen::Index(bytes.size() / sizeof(double)));
  std::copy_n(bytes.data(), size_t(v.size()) * sizeof(double),
              reinterpret_cast<uint8_t*>(v.data()));
  return v;
}

}  // namespace

std::vector<uint8_t> state_bytes(const StreamState& state) {
  if (state.unknowns.size() == 0) return {};
  BodyWriter body;
  body.add(std::vector<uint8_t>(state.prior.begin(), state.prior.end()));
  add_vector(body, state.unknowns), add_vector(body, state.shape);
  return body.take();
}

StreamState stream_state(const std::vector<uint8_t>& bytes) {
  if (bytes.empty()) return {};
  BodyReader body(bytes);
  const auto prior = body.block();
  StreamState state{{prior.begin(), prior.end()}, {}, {}};
  state.unknowns = vector_of(body.block()), state.shape = vector_of(body.block());
  return state;
}

}  // namespace genio
