#pragma once
// A contour is one curve: what lies far from its neighbours in the file is none of it.

#include "inverse/recording/base/contours.hpp"

namespace genio {

/// The file, in metres, with stray points of its curves left out, at most three in a row between
/// jumps of over 15 mm and eight times the usual spacing; the frame's note and the remarks count
/// them. A frame whose points go on and then start again beside the first ones, two takes in one,
/// keeps no point and says why. Throws InputError naming `path` and the frame where those are more
/// than a tenth.
ContourFile with_one_curve_a_frame(ContourFile file, const std::string& path);

}  // namespace genio
