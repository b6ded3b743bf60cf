#pragma once
#include <cstdint>

namespace genio {

/// Microseconds by a clock that nobody can set, for what happens within this process: at the first
/// call as now_us(), and steady from then on.
int64_t process_us();

/// What to add to a time of process_us() for that of now_us() [us]: by how much the clock was set.
int64_t wall_lead_us();

}  // namespace genio
