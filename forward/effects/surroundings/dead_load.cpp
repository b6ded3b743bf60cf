#include "forward/effects/surroundings/dead_load.hpp"

namespace genio {

DeadLoad::DeadLoad(std::string name, Forces weights, double force)
    : name_(std::move(name)),
      weights_(std::move(weights)),
      info_{{{"force", "N", force, -1e6, 1e6, 0, true}}} {}

}  // namespace genio
