#pragma once
#include <string>
#include <vector>

#include "forward/model/model.hpp"

namespace genio {

/// The deformed tongue (blue) over the one at rest (grey), in the midsagittal plane with bones, and
/// from the front: an SVG.
std::string draw_shape(const Model& model, const Positions& x, const std::string& title);

/// A deformed tongue among others of one panel.
struct DrawnShape {
  std::string name, colour;
  Positions x;  ///< [m]
};

/// Shapes of one frame, with the words below it.
struct SidePanel {
  std::string below;
  std::vector<DrawnShape> shapes;
};

/// Midsagittal lines over the one at rest (grey) with bones, a frame a panel from left to right: an
/// SVG. A frame is as wide as its lines need. The legend names the shapes of the first panel.
std::string draw_side_by_side(const Model& model, const std::vector<SidePanel>& panels,
                              const std::string& title);

}  // namespace genio
