#pragma once
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// DIR/checkpoint.json: where a joint problem stands, the unknowns of each of its frames or knots.
/// Without a folder nothing is kept.
class Checkpoint {
 public:
  /// Reads what is there where `resume` asks for it. Throws InputError for a damaged file.
  Checkpoint(const std::string& folder, bool resume);
  const std::vector<Vector>& known() const { return known_; }
  /// Replaces the file at once, so that an interruption leaves one or the other.
  void keep(const std::vector<Vector>& unknowns) const;

 private:
  std::string path_;
  std::vector<Vector> known_;
};

}  // namespace genio
