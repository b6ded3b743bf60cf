#pragma once
// How a recording was laid beside the model, as tables and pictures tell it.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace genio {

/// What of a kept registration goes into tables; NaN and empty where the answer does not tell.
struct Laid {
  double scale, tilt_deg, shift_back_mm, shift_up_mm;
  double palate_rms_mm, from_rest_mm, off_reach_mm, behind_palate;
  std::string units, axes, points_order, by;
  bool doubtful = false, forced = false;
};

/// Of an object of registration_json(), or of none.
Laid laid_in(const nlohmann::json& registration);
/// The same of its text, which may be empty.
Laid laid_in(const std::string& registration);

/// "registration_scale,registration_tilt_deg,...": titles of the columns of a table.
std::string laid_titles();
/// Their fields, with commas between them.
std::string laid_fields(const Laid& laid);

/// Two lines for a picture: how it was laid there, and what was read of it. None where the answer
/// does not tell.
std::vector<std::string> laid_words(const Laid& laid);

}  // namespace genio
