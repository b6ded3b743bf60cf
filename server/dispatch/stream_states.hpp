#pragma once
#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace genio {

/// Where the last frame of each stream ended, as its worker tells it; the streams that were longest
/// without a frame are forgotten first.
class StreamStates {
 public:
  StreamStates(size_t most, size_t most_bytes) : most_(most), most_bytes_(most_bytes) {}

  /// Empty where nothing is known.
  const std::vector<uint8_t>& find(const std::string& stream) const;
  /// An empty state is none.
  void keep(const std::string& stream, std::vector<uint8_t> state);

 private:
  struct Kept {
    std::vector<uint8_t> state;
    std::list<std::string>::iterator age;
  };
  void forget(const std::string& stream);

  size_t most_, most_bytes_, bytes_ = 0;
  std::map<std::string, Kept> kept_;
  std::list<std::string> ages_;  // oldest first
};

}  // namespace genio
