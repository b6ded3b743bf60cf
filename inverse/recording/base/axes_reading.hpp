#pragma once
// Which way a device's axes point: what seldom stands in a file, and all its files share.

#include "inverse/recording/base/file_axes.hpp"

namespace genio {

/// One way to read them. The numbers are those of the file's three coordinates: of a midsagittal
/// contour 0 and 2.
struct AxesReading {
  int back = 0, up = 2;    ///< which one runs along the head, and which one up
  bool back_grows = true;  ///< false: it grows towards the face, which looks right
  bool up_grows = true;    ///< false: it grows downwards, as in images
  bool operator==(const AxesReading&) const = default;

  /// "face left, y up", or of sensors "x runs back, z runs up".
  std::string text(Content content) const;
  /// The options that ask for it.
  std::string options(Content content) const;
};

/// The three-letter form of --axes, as in "-x+z": along the head backwards, then up. Throws
/// InputError where it is none.
AxesReading parse_axes(const std::string& text);

/// The file's coordinates turned so that they are (back, across, up). Sensors lose what they say
/// across: heads are not held level to a millimetre.
ContourFile turned(ContourFile file, const AxesReading& reading);

}  // namespace genio
