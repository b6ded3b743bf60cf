#pragma once
// Figures of merit, measured where they are asked for. Each returns one JSON object.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "forward/model/build_model.hpp"

namespace genio::bench {

using Json = nlohmann::json;
/// One line a step for people who wait; may be empty.
using Progress = std::function<void(const std::string&)>;

/// Static solves of the block in units of one factorisation, beside CalculiX where it is installed.
Json forward(const Progress& progress);

/// 120 ms of motion in 2 ms steps: the block, and GGP 2 N on the model at `model` and on the
/// Grenoble tongue of `grenoble_folder` (may be empty), whole and half.
Json dynamic(const std::string& model, const std::string& grenoble_folder,
             const Progress& progress);

/// Equilibria under `count` random force vectors up to half of every maximum, from rest, and once
/// more from a neighbour; pairs of different equilibria for the same forces are listed.
Json robustness(const Model& model, int count, const Progress& progress);

/// The verification's tables: manufactured solution, Cook's membrane, sphere, order in time, and
/// CalculiX (where installed) on the block and, with its folder, on the Grenoble tongue.
Json verification(const std::string& grenoble_folder, const Progress& progress);

/// Known forces of three muscles found again from their noiseless contour: time of a cold and of a
/// warm inversion over that of the forward solve, and of the same optimiser with a
/// finite-difference gradient over that with the exact one.
Json inversion_cost(const Model& model, const Progress& progress);

/// Inversion without inverse crime: targets from the model refined by eight with fibres turned by 5
/// degrees, 0.5 mm noise, `count` random force vectors of 2 to 5 muscles up to 30 % of maximum.
/// RMS from the clean shape, coverage of the 90 % intervals, error of identified forces.
Json blind(const ModelDescription& description, int count, const Progress& progress);

/// Round trips over LCM on 127.0.0.1 beside the bare computation.
Json service(const Model& model);

/// One frame from the middle of each label (word) of a recording, each cold, or all frames, each
/// from where the one before ended; registered by its palate trace. Throws InputError for files
/// that cannot be read.
Json ultrasound(const Model& model, const std::string& contours, const std::string& palate,
                bool all, const Progress& progress);

/// `count` targets of the model itself, from rest to the edge of what muscles can do: random
/// vectors of 2 to 5 muscles, the strongest from next to nothing to its maximum.
Json reach(const Model& model, int count, const Progress& progress);

/// The Grenoble tongue of `folder` asked to move 22 nodes 10 mm forward, where a stored run of the
/// peer's inverse controller misses by 2.07 mm RMS.
Json peer(const std::string& folder, const Progress& progress);

/// A 200 ms gesture with two targets inverted with its inertia, over the time of its simulation.
Json gesture(const Model& model, const Progress& progress);

/// The Grenoble tongue in postures that CalculiX makes with gravity, seen with noise; what the
/// discovery says of a model without gravity.
Json grenoble_gravity(const std::string& folder, const Progress& progress);

/// The Grenoble tongue of `folder` under GGP and HG: without contact against an independent static
/// solution of the same problem, with contact beside the seed paper's printed figures.
Json grenoble(const std::string& folder, const Progress& progress);

}  // namespace genio::bench
