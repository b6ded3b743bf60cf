#include "server/wire/body.hpp"

#include <cstring>
#include <stdexcept>

namespace genio {
namespace {

template <class T>
void append_value(std::vector<uint8_t>& bytes, const T& value) {
  const auto* begin = reinterpret_cast<const uint8_t*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof value);
}

}  // namespace

BodyWriter& BodyWriter::add(double value) { return append_value(body_, value), *this; }
BodyWriter& BodyWriter::add(int64_t value) { return append_value(body_, value), *this; }

BodyWriter& BodyWriter::add(const std::vector<uint8_t>& block) {
  append_value(body_, uint64_t(block.size()));
  body_.insert(body_.end(), block.begin(), block.end());
  return *this;
}

void BodyReader::copy(void* to, size_t size) {
  if (body_.size() - at_ < size) throw std::runtime_error("a block of values ends early");
  if (size > 0) std::memcpy(to, body_.data() + at_, size);
  at_ += size;
}

double BodyReader::number() {
  double value = 0;
  return copy(&value, sizeof value), value;
}

int64_t BodyReader::integer() {
  int64_t value = 0;
  return copy(&value, sizeof value), value;
}

std::vector<uint8_t> BodyReader::block() {
  uint64_t size = 0;
  copy(&size, sizeof size);
  if (size > body_.size() - at_) throw std::runtime_error("a block of values ends early");
  std::vector<uint8_t> block(size);
  return copy(block.data(), block.size()), block;
}

}  // namespace genio
