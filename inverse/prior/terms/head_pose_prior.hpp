#pragma once
#include <optional>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Where head and sensors may have moved against each other, about the target's middle.
struct HeadPosePrior {
  double shift_sd = 0;  ///< along x and z [m]
  double turn_sd = 0;   ///< in the midsagittal plane [rad]
};

/// A head that may have moved against the sensors, estimated along.
struct HeadPoseTerm {
  std::optional<HeadPosePrior> head_pose;

  /// Shift along x and z, and turn; none where the head keeps still.
  std::vector<Unknown> unknowns(const Model& model) const;
  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  /// A motion in the midsagittal plane is the same for both halves.
  HeadPoseTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"head_pose"}; }
  static HeadPoseTerm read(const TomlReader& file);
};

}  // namespace genio
