#pragma once
// Praat's TextGrids: what was said when.

#include <string>
#include <vector>

namespace genio {

/// An interval with its label, or a point where both times are the same [s].
struct TimedLabel {
  double first_s = 0, last_s = 0;
  std::string label;

  double middle_s() const { return 0.5 * (first_s + last_s); }
};

struct TextGridTier {
  std::string name;
  bool points = false;  ///< else intervals
  std::vector<TimedLabel> labels;
};

/// The tiers of a TextGrid in long or short text form, in UTF-8, UTF-16 or Latin-1; labels in
/// UTF-8. Throws InputError naming file, line and what was expected, and for binary and
/// chronological files what to save them as.
std::vector<TextGridTier> read_textgrid(const std::string& path);

/// The tier of that name; the only one where `name` is empty. Throws InputError naming `path`, the
/// tiers that it has and the nearest of them.
const TextGridTier& tier_named(const std::vector<TextGridTier>& tiers, const std::string& name,
                               const std::string& path);

}  // namespace genio
