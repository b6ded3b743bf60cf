#pragma once
// Reads every recording of a corpus once, and cuts its frames into tasks.

#include <map>

#include "runs/corpus/manifest.hpp"
#include "runs/corpus/plan.hpp"

namespace genio {

/// The models of a corpus, each read when it is first asked for.
class Models {
 public:
  /// Throws InputError as read_model() does, each time.
  const Model& get(const std::string& path);

 private:
  std::map<std::string, Model> models_;
};

/// What the answers of a recording depend on: what `genio invert` asks, which frames, and the names
/// that they bear. `noise` [m] of its frames.
Question planned_question(const InversionOptions& o, double noise, const PlannedRecording& r);

struct PlanningOptions {
  int share = 0;  ///< frames a task; 0: usual_share()
  int processes = 1;
  bool resume = false;
};

/// Hears of each recording that was read: how many of how many are.
using TakeRead = std::function<void(const PlannedRecording&, int done, int total)>;

/// The plan of a manifest, in DIR/plan.json, with each recording kept in a folder of its own. A
/// recording that cannot be read or laid beside its model is refused with the reason, and the rest
/// goes on. With `resume` only new and refused recordings are read, and those whose folder was
/// removed; tasks of the others stay as they are. Throws InputError where `out` holds a plan
/// already, or with `resume` where a recording, its model or an option is not as it was planned.
Plan plan_corpus(const Manifest& manifest, const std::string& out, const PlanningOptions& options,
                 const ReadWords& read, Models& models, const TakeRead& take);

}  // namespace genio
