#pragma once
// The numbers of a place, which requests and replies have under the same names.

#include <numbers>

#include "inverse/prior/terms/head_pose_prior.hpp"
#include "inverse/recording/registration/registration.hpp"

namespace genio {

/// Where points lie beside the model, and how well that is known; 0: exactly.
struct MessagePlace {
  Similarity transform;
  HeadPosePrior head;
};

inline constexpr double place_degree = std::numbers::pi / 180;

template <class Message>
void put_place(const MessagePlace& place, Message& m) {
  const Similarity& s = place.transform;
  m.scale = s.scale, m.tilt_deg = s.angle / place_degree;
  m.shift_x_mm = 1e3 * s.shift[0], m.shift_z_mm = 1e3 * s.shift[1];
  m.shift_sd_mm = 1e3 * place.head.shift_sd, m.tilt_sd_deg = place.head.turn_sd / place_degree;
}

template <class Message>
MessagePlace place_in(const Message& m) {
  return {{m.scale, m.tilt_deg * place_degree, 1e-3 * Vec2(m.shift_x_mm, m.shift_z_mm)},
          {1e-3 * m.shift_sd_mm, m.tilt_sd_deg * place_degree}};
}

}  // namespace genio
