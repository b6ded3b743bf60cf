#include "inverse/recording/binary/data_tree.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

#include "forward/base/types.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr int deepest_packed = 8;

void put(std::string& bytes, uint64_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text;
}

void put(std::string& bytes, const DataTree& tree) {
  put(bytes, uint64_t(tree.kind));
  put(bytes, tree.name), put(bytes, tree.text);
  put(bytes, tree.rows), put(bytes, tree.columns);
  put(bytes, tree.numbers.size());
  bytes.append(reinterpret_cast<const char*>(tree.numbers.data()),
               tree.numbers.size() * sizeof(double));
  put(bytes, tree.children.size());
  for (const DataTree& child : tree.children) put(bytes, child);
}

/// Takes values off the front of bytes that nobody vouches for.
class Taker {
 public:
  explicit Taker(const std::string& bytes) : bytes_(bytes) {}
  DataTree tree(int depth) {
    if (depth > deepest_packed) refuse();
    DataTree t;
    const uint64_t kind = number();
    if (kind > uint64_t(DataTree::Kind::record)) refuse();
    t.kind = DataTree::Kind(kind);
    t.name = text(), t.text = text();
    t.rows = number(), t.columns = number();
    t.numbers.resize(count(sizeof(double)));
    take(t.numbers.data(), t.numbers.size() * sizeof(double));
    if (!t.numbers.empty() && (t.columns == 0 || t.numbers.size() / t.columns != t.rows ||
                               t.numbers.size() % t.columns != 0))
      refuse();
    const size_t children = count(sizeof(uint64_t));
    for (size_t k = 0; k < children; ++k) t.children.push_back(tree(depth + 1));
    return t;
  }
  bool at_end() const { return at_ == bytes_.size(); }
  [[noreturn]] static void refuse() { throw InputError("its contents are no tree of values"); }

 private:
  void take(void* to, size_t size) {
    if (size > bytes_.size() - at_) refuse();
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  uint64_t number() {
    uint64_t value = 0;
    take(&value, sizeof value);
    return value;
  }
  /// How many items follow, of at least `size` bytes each.
  size_t count(size_t size) {
    const uint64_t value = number();
    if (value > (bytes_.size() - at_) / size) refuse();
    return value;
  }
  std::string text() {
    std::string value(count(1), '\0');
    take(value.data(), value.size());
    return value;
  }

  const std::string& bytes_;
  size_t at_ = 0;
};

}  // namespace

const DataTree* DataTree::find(const std::string& child) const {
  for (const DataTree& c : children)
    if (lower_case(c.name) == lower_case(child)) return &c;
  return nullptr;
}

double DataTree::scalar() const {
  return numbers.size() == 1 ? numbers.front() : std::numeric_limits<double>::quiet_NaN();
}

std::string packed(const DataTree& tree) {
  std::string bytes;
  put(bytes, tree);
  return bytes;
}

DataTree unpacked(const std::string& bytes) {
  Taker taker(bytes);
  DataTree tree = taker.tree(0);
  if (!taker.at_end()) Taker::refuse();
  return tree;
}

}  // namespace genio
