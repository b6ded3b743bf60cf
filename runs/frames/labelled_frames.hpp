#pragma once
#include <functional>
#include <string>
#include <vector>

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// Half of the usual time between neighbouring frames [s]; 0 where there is but one.
double half_spacing(const std::vector<ContourFrame>& frames);

/// The frames that a tier of a TextGrid names, with its labels: of each labelled interval the one
/// nearest to its middle, of each labelled point the nearest. Where the frames are of several
/// recordings, those of the recording that the TextGrid is named after. `remark` hears which labels
/// lie where there is no frame. Throws InputError naming the option, where the frames have no
/// times, or none of them is named.
std::vector<ContourFrame> labelled_frames(std::vector<ContourFrame> frames,
                                          const std::string& textgrid, const std::string& tier,
                                          const std::string& path,
                                          const std::function<void(const std::string&)>& remark);

}  // namespace genio
