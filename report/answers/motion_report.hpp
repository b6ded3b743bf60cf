#pragma once
// Shapes and motions as files that ParaView opens.

#include <string>

#include "forward/motion/dynamics.hpp"

namespace genio {

/// The tongue in the shape x as a VTU file, with the displacement from rest [m].
void write_shape(const Model& model, const Positions& x, const std::string& path);

/// Writes motion.pvd with one VTU an instant, and landmarks.csv: time_s, displacement of tip,
/// dorsum and root [mm], and the energies [J].
void write_motion(const Model& model, const Trajectory& trajectory, const std::string& folder);

}  // namespace genio
