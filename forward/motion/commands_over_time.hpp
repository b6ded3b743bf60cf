#pragma once
// Parameters as functions of time.

#include <string>
#include <vector>

#include "forward/model/model.hpp"

namespace genio {

/// Values of all parameters, linear between times; held before the first and after the last.
struct CommandsOverTime {
  std::vector<double> times;  ///< [s], rising; equal neighbours make a jump
  std::vector<Parameters> values;

  /// Just after a jump where the time is one.
  Parameters at(double time) const;
};

/// `from` until 0, `to` from `ramp` on; a step where `ramp` is 0.
CommandsOverTime ramp(const Parameters& from, const Parameters& to, double ramp);

/// Reads a CSV: `time_s`, then a column a command ("GGP" or "GGP_N", newtons; a bilateral name
/// drives both sides) or parameter ("jaw_opening.angle"). Other parameters stay at `base`. Throws
/// InputError naming file, line and column.
CommandsOverTime read_commands(const Model& model, const std::string& path, const Parameters& base);

/// The commands as the muscles follow them, where the model has a filter of them; else as given.
CommandsOverTime activated(const Model& model, const CommandsOverTime& commands);

}  // namespace genio
