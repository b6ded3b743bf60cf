#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace genio::test {

/// Choices out of the bytes of an input. Where they have ended, every choice is 0.
class FuzzScript {
 public:
  explicit FuzzScript(std::string_view bytes) : bytes_(bytes) {}

  bool ended() const { return bytes_.empty(); }
  uint8_t byte() {
    if (ended()) return 0;
    const auto first = uint8_t(bytes_.front());
    bytes_.remove_prefix(1);
    return first;
  }
  /// 0 to `count` - 1.
  size_t below(size_t count) { return byte() % count; }
  /// Up to `count` bytes.
  std::string_view take(size_t count) {
    const std::string_view some = bytes_.substr(0, count);
    bytes_.remove_prefix(some.size());
    return some;
  }
  std::string_view rest() { return take(bytes_.size()); }

 private:
  std::string_view bytes_;
};

/// What must hold whatever the input is; its failure is a finding.
inline void hold(bool true_always, const char* what) {
  if (!true_always) throw std::logic_error(what);
}

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace genio::test
