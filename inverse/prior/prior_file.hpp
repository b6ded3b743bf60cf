#pragma once
#include "inverse/prior/prior.hpp"

namespace genio {

/// Reads `path`: a TOML file, or a CSV of EMG alone. In TOML: effort_sd, muscles_rest, symmetry_sd,
/// smoothness_sd, emg = "file.csv" (beside it) or [emg.NAME] mean, sd; [cocontraction] mean, sd;
/// [fixed_N] NAME = force; [parameter."jaw_opening.angle"] mean, sd; [head_pose] shift_sd_mm,
/// turn_sd_deg.
/// EMG: one header line `muscle,mean,sd` (activations, 0 to 1). Throws InputError naming file,
/// line and field.
Prior read_prior(const std::string& path);

/// The same of TOML that came without a file, and that may name none. Throws InputError as in
/// "NAME, line 3: ...".
Prior prior_of_text(const std::string& name, const std::string& text);

/// The prior of a file as TOML that names no other file: EMG stands in it. Throws as read_prior().
std::string prior_text(const std::string& path);

}  // namespace genio
