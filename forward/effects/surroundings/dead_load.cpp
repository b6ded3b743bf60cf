#include "forward/effects/surroundings/dead_load.hpp"

namespace genio {

DeadLoad::DeadLoad(std::string name, Forces weights, double force)
    : name_(std::move(name)),
      weights_(std::move(weights)),
      info_{{{.name = "force",
              .unit = "N",
              .value = force,
              .lower = -1e6,
              .upper = 1e6,
              .load = true}}} {}

}  // namespace genio
