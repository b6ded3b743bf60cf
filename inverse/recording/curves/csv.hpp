#pragma once
#include "inverse/recording/base/contour_format.hpp"

namespace genio {

/// Our own table, in the model's frame: `frame,point,x_mm,[y_mm,]z_mm[,sigma_mm][,kind][,label]
/// [,time_s][,rest_x_mm,rest_y_mm,rest_z_mm][,slice][,recording][,speaker]`, separated by commas,
/// semicolons or tabs.
ContourFormat csv_format();

}  // namespace genio
