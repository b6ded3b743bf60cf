#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace genio {

/// Values one after another as bytes, in this machine's order: both sides are of one program.
class BodyWriter {
 public:
  BodyWriter& add(double value);
  BodyWriter& add(int64_t value);
  /// Its length comes first.
  BodyWriter& add(const std::vector<uint8_t>& block);
  std::vector<uint8_t> take() { return std::move(body_); }

 private:
  std::vector<uint8_t> body_;
};

/// Reads what BodyWriter wrote, in the same order. Throws std::runtime_error where it ends early.
class BodyReader {
 public:
  explicit BodyReader(const std::vector<uint8_t>& body) : body_(body) {}
  double number();
  int64_t integer();
  std::vector<uint8_t> block();

 private:
  void copy(void* to, size_t size);
  const std::vector<uint8_t>& body_;
  size_t at_ = 0;
};

}  // namespace genio
