#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// All formats of flesh points. One that knows its files by less stands below those that know
/// theirs by more.
const std::vector<ContourFormat>& sensor_formats();

/// The one of sensor_formats() whose file it is; null where none knows it.
const ContourFormat* sensor_format_of(const FileStart& start);

}  // namespace genio
