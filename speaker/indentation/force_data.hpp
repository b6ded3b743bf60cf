#pragma once
// A measured curve of force against depth.

#include <optional>
#include <string>
#include <vector>

#include "forward/base/types.hpp"
#include "speaker/indentation/indentation_model.hpp"

namespace genio {

/// Rows of a measurement, by rising depth.
struct ForceData {
  Vector depth;              ///< [m]
  Vector force;              ///< [N]
  std::optional<Vector> sd;  ///< standard deviation of each force [N], where it is known
};

/// What a file, or a person, says of an experiment; the rest is usual.
struct ExperimentNotes {
  std::optional<std::string> indenter;
  std::optional<double> radius_mm, thickness_mm, half_width_mm, mucosa_mm, poisson_ratio;
  std::optional<double> mucosa_a10_Pa, mucosa_a20_Pa;
};

struct ForceFile {
  ForceData data;
  ExperimentNotes notes;
};

/// Reads a table with the columns force_N, depth_mm and, where the scatter is known, sd [N]; others
/// are left unread. Lines `# key = value` before the header tell of the experiment by the names of
/// ExperimentNotes. Throws InputError naming file, line and column: numbers that are none, negative
/// depths, fewer than 5 depths, depths that rise nor fall, forces at one depth that contradict one
/// another, and numbers that look like other units.
ForceFile read_force_file(const std::string& path);

/// `said` where it says something, else `otherwise`.
ExperimentNotes merged(const ExperimentNotes& said, const ExperimentNotes& otherwise);

/// The experiment of some notes. Where they do not say: a punch of 5 mm on 20 mm of tissue whose
/// sides are ten radii away; the usual mucosa is 1 mm thick. Throws InputError as check() does.
IndentationExperiment experiment_of(const ExperimentNotes& notes, bool with_mucosa);

/// What the notes say of the mucosa, else twice the constants of dead muscle: none are published.
YeohConstants mucosa_of(const ExperimentNotes& notes);

}  // namespace genio
