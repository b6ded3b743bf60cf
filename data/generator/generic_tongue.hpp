#pragma once
#include "forward/model/model_file.hpp"

namespace genio::generic {

/// How finely the tongue is divided: elements along the surface line, from front to surface, and
/// across half the width.
struct Resolution {
  int along = 14, deep = 6, across = 5;
};

/// The generic tongue: hexahedra laid out along muscle directions (a fan from the mental spine),
/// muscles as fibres along mesh lines, palate, jaw and hyoid, supports, living-tissue constants.
ModelDescription make_generic_tongue(const Resolution& resolution = {});

}  // namespace genio::generic
