#pragma once
// Ways in which recordings go wrong on their way to the program.

#include "bench/experiments/recordings/synthetic_session.hpp"

namespace genio::bench {

struct Spoil {
  std::string name;
  /// Changes the session, or what was written of it; false where that does no harm to it.
  bool (*before)(SyntheticSession&, const Model&, std::mt19937&) = nullptr;
  bool (*after)(WrittenSession&, std::mt19937&) = nullptr;
};

const std::vector<Spoil>& spoils();

}  // namespace genio::bench
