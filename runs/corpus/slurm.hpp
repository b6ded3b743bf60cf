#pragma once
// A corpus as a job array of Slurm. When and where a task runs is Slurm's business.

#include <string>
#include <vector>

namespace genio {

struct SlurmJob {
  std::string program, out;          ///< genio itself, and the folder of the corpus; absolute
  std::vector<int> tasks;            ///< rising
  int at_once = 0;                   ///< tasks that may run at one time; 0: as many as Slurm likes
  std::vector<std::string> options;  ///< more of sbatch's, as "--partition=long"
};

/// "0-3,7,9-10".
std::string array_ranges(const std::vector<int>& tasks);

/// Throws InputError for what is no option of sbatch, and for one that is the corpus's own.
void check_sbatch_options(const std::vector<std::string>& options);

/// Writes OUT/slurm/tasks.sh, the array, and OUT/slurm/merge.sh, which follows it.
void write_scripts(const SlurmJob& job);

struct SubmittedJobs {
  std::string array, merge;  ///< their ids
};
/// Submits what write_scripts() wrote. Throws InputError with what sbatch said.
SubmittedJobs submit(const SlurmJob& job);

}  // namespace genio
